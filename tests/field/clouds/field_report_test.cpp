// scripts/field_report.sh on a folder with a good and a bad input of each kind.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "inputs.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using test::input;

struct Report {
  int status = -1;
  std::string text;
};

/// Of the folder, made by `program`, which may take so long of the processor.
Report report(const fs::path& folder, const std::string& program, int seconds = 60) {
  const std::string command = "CANOPEER='" + program +
                              "' " CANOPEER_SOURCE_DIR "/scripts/field_report.sh '" +
                              folder.string() + "' " + std::to_string(seconds) + " 2>&1";
  Report report;
  std::FILE* const pipe = popen(command.c_str(), "r");
  char piece[256];
  while (std::fgets(piece, sizeof piece, pipe) != nullptr) report.text += piece;
  report.status = WEXITSTATUS(pclose(pipe));
  return report;
}

/// The line about a file, or nothing.
std::string line_about(const Report& report, const std::string& name) {
  const std::size_t at = report.text.find(" " + name + "  ");
  if (at == std::string::npos) return "";
  const std::size_t begin = report.text.rfind('\n', at) + 1;
  return report.text.substr(begin, report.text.find('\n', at) - begin);
}

constexpr char kArm[] =
    "<robot name='a'><link name='base'/><!-- <joint name='no' type='revolute'> -->\n"
    "<joint name='j1' type='revolute'><parent link='base'/><child link='l1'/>\n"
    "<axis xyz='0 0 1'/><limit lower='-1' upper='1' velocity='1' effort='1'/></joint>\n"
    "<link name='l1'/><joint name='j2' type='fixed'><parent link='l1'/><child link='camera'/>"
    "</joint><link name='camera'/></robot>\n";
constexpr char kBox[] =
    "<sdf version='1.6'><model name='m'><link name='l'><visual name='v'><geometry><box><size>1 1 1"
    "</size></box></geometry></visual></link></model></sdf>\n";
constexpr char kMesh[] =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
    "3 0 1 2\n";

TEST(FieldReport, NamesWhatIsReadAndWhatIsRefused) {
  const test::TemporaryDirectory directory;
  const fs::path folder = directory / "field";
  fs::create_directories(folder / "good");
  fs::create_directories(folder / "bad/room");
  const auto write = [&](const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file(folder / name, text)) << name;
  };
  write("good/arm.urdf", kArm);
  write("bad/arm.urdf", "<robot name='a'><link name='base'>");
  write("good/box.sdf", kBox);
  write("bad/box.sdf", "<sdf version='1.6'><model name='m'>");
  write("good/mesh.ply", kMesh);
  write("bad/mesh.obj", "\x89PNG\r\n");
  write("good/rows.yaml", "preset: seedlings\n");
  write("bad/rows.yaml", "preset: seedling\n");
  fs::copy_file(input("fruit/points.xyz"), folder / "good/fruit.xyz");
  fs::copy_file(input("fruit/bad_number.csv"), folder / "bad/fruit.csv");
  fs::copy(input("room"), folder / "good/room", fs::copy_options::recursive);
  write("bad/room/depth.txt", "1.0 depth/1.png\n");
  const auto map = folder / "good/room.ot";
  ASSERT_EQ(test::canopeer({"map", "fuse", input("room").string(), "--out", map.string(),
                            "--resolution", "0.1"})
                .status,
            0);
  write("bad/room.ot", "# Octomap OcTree file\nid OcTree\n");

  const Report all = report(folder, CANOPEER_PROGRAM);
  EXPECT_EQ(all.status, 0) << all.text;
  const std::pair<const char*, const char*> good[] = {
      {"good/arm.urdf", "robot"},  {"good/box.sdf", "world"},
      {"good/mesh.ply", "world"},  {"good/rows.yaml", "scene"},
      {"good/fruit.xyz", "cloud"}, {"good/room/depth.txt", "recording"},
      {"good/room.ot", "map"}};
  for (const auto& [name, kind] : good) {
    const std::string line = line_about(all, name);
    // A bare arm is read, and told that it has no places to work.
    const char* status = std::string(kind) == "robot" ? "faulty" : "read";
    EXPECT_EQ(line.rfind(status, 0), 0U) << name << ": " << line;
    EXPECT_NE(line.find(std::string(" ") + kind + " "), std::string::npos) << line;
  }
  for (const char* name : {"bad/arm.urdf", "bad/box.sdf", "bad/mesh.obj", "bad/rows.yaml",
                           "bad/fruit.csv", "bad/room/depth.txt", "bad/room.ot"}) {
    const std::string line = line_about(all, name);
    EXPECT_EQ(line.rfind("refused", 0), 0U) << name << ": " << line;
    EXPECT_GT(line.size(), 60U) << "no reason: " << line;
  }
}

TEST(FieldReport, EndsWithOneWhenAnythingAborts) {
  const test::TemporaryDirectory directory;
  const fs::path folder = directory / "field";
  fs::create_directories(folder);
  ASSERT_TRUE(write_file(folder / "a.ot", ""));
  const fs::path aborts = directory / "aborts";
  ASSERT_TRUE(write_file(aborts, "#!/bin/sh\necho 'canopeer: oh' >&2\nkill -ABRT $$\n"));
  fs::permissions(aborts, fs::perms::owner_all);
  const Report broken = report(folder, aborts.string());
  EXPECT_EQ(broken.status, 1) << broken.text;
  EXPECT_EQ(line_about(broken, "a.ot").rfind("aborted", 0), 0U) << broken.text;
  EXPECT_EQ(report("/nonexistent", aborts.string()).status, 2);
}

TEST(FieldReport, StopsWhatTakesTooMuchOfTheProcessor) {
  const test::TemporaryDirectory directory;
  const fs::path folder = directory / "field";
  fs::create_directories(folder);
  ASSERT_TRUE(write_file(folder / "a.ot", ""));
  const fs::path turns = directory / "turns";
  ASSERT_TRUE(write_file(turns, "#!/bin/sh\nwhile :; do :; done\n"));
  fs::permissions(turns, fs::perms::owner_all);
  const Report slow = report(folder, turns.string(), 1);
  EXPECT_EQ(slow.status, 1) << slow.text;
  EXPECT_EQ(line_about(slow, "a.ot").rfind("slow", 0), 0U) << slow.text;
}

}  // namespace
}  // namespace canopeer
