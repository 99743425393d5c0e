#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/csv_table.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

const std::string kWorld = "missions/own_world/glasshouse.world";
const std::string kModels = "missions/own_world/models";
const std::string kFruit = "pepper_(red|orange|green)";
const std::string kCounted = "pepper_(red|orange)";

TEST(OwnWorld, AMissionOnAnImportedWorldIsAMissionLikeAnyOther) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "run";
  const auto result = test::canopeer({"run", "missions/own_world.yaml", "--out", out.string()});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("imported glasshouse"), std::string::npos) << result.err;
  for (const char* file : {"record", "timeline.csv", "fruits.csv", "fruits.ply", "map.ot",
                           "ground_truth.csv", "pictures/01_row.png", "report.html"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
  const std::string summary = read_file(out / "summary.json").value_or("");
  // Three tall plants with 3 counted fruits each, three short ones with 2.
  EXPECT_NE(summary.find("\"fruits_total\": 15"), std::string::npos) << summary;
  const auto truth = CsvTable::read(out / "ground_truth.csv");
  ASSERT_TRUE(truth.has_value());
  EXPECT_EQ(truth->rows(), 21U);
  EXPECT_TRUE(truth->has("hull_volume_cm3") && truth->has("model"));
  const auto found = CsvTable::read(out / "fruits.csv");
  ASSERT_TRUE(found.has_value());
  EXPECT_GE(found->rows(), 4U);
  // The report can be made anew from the directory alone.
  EXPECT_EQ(test::canopeer({"report", out.string()}).status, 0);
}

TEST(OwnWorld, TheSameSeedGivesTheSameRecord) {
  const test::TemporaryDirectory directory;
  const auto record = [&](const std::string& threads) {
    const auto out = directory / threads;
    const auto result =
        test::canopeer({"run", "missions/own_world.yaml", "--segments", "1", "--time-per-segment",
                        "4", "--threads", threads, "--quiet", "--out", out.string()});
    EXPECT_EQ(result.status, 0) << result.err;
    return read_file(out / "record").value_or("");
  };
  const std::string one = record("1");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == record("2"));
}

TEST(SceneImport, WritesSceneGroundTruthAndPicture) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "scene";
  const auto result =
      test::canopeer({"scene", "import", kWorld, "--model-path", kModels, "--fruit", kFruit,
                      "--counted", kCounted, "--leaf", "leaf", "--out", out.string()});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* file : {"scene.glb", "scene.png", "parts.csv"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
  const std::string truth = read_file(out / "ground_truth.csv").value_or("");
  EXPECT_EQ(truth.find("id,class,counted,x_m,y_m,z_m,length_m,diameter_m,hull_volume_cm3,"
                       "surface_cm2,model\n"),
            0U);
  EXPECT_EQ(std::count(truth.begin(), truth.end(), '\n'), 22);
  EXPECT_NE(truth.find(",left_3\n"), std::string::npos);

  // The scene it wrote is itself a world to import, with the same fruits.
  const auto again = directory / "again";
  const auto second =
      test::canopeer({"scene", "import", (out / "scene.glb").string(), "--fruit", "^fruit",
                      "--counted", "_counted", "--leaf", "^leaf", "--out", again.string()});
  ASSERT_EQ(second.status, 0) << second.err;
  const auto a = CsvTable::read(out / "ground_truth.csv");
  const auto b = CsvTable::read(again / "ground_truth.csv");
  ASSERT_TRUE(a.has_value() && b.has_value());
  ASSERT_EQ(a->rows(), b->rows());
  for (std::size_t row = 0; row < a->rows(); ++row) {
    EXPECT_EQ(a->text(row, "model").value(), b->text(row, "model").value());
    EXPECT_EQ(a->integer(row, "counted").value(), b->integer(row, "counted").value());
    for (const char* column : {"x_m", "y_m", "z_m", "length_m"}) {
      EXPECT_NEAR(a->number(row, column).value(), b->number(row, column).value(), 2e-4) << column;
    }
  }
}

TEST(SceneImport, AMissionsImportedWorldCanBeLookedAt) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "scene";
  const auto rendered =
      test::canopeer({"scene", "render", "missions/own_world.yaml", "--out", out.string()});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_TRUE(fs::exists(out / "row.png"));
  EXPECT_TRUE(fs::exists(out / "segment_1_labels.png"));
  const auto inspected = test::canopeer({"scene", "inspect", "missions/own_world.yaml"});
  ASSERT_EQ(inspected.status, 0);
  EXPECT_NE(inspected.out.find("fruits_counted    15"), std::string::npos) << inspected.out;
  EXPECT_NE(inspected.out.find("plants            6"), std::string::npos) << inspected.out;
}

TEST(SceneImport, WhatIsMissingIsSaidAndOnlyATextureCanBeDoneWithout) {
  const test::TemporaryDirectory directory;
  const fs::path models = directory / "models";
  fs::copy(fs::path(CANOPEER_SOURCE_DIR) / kModels, models, fs::copy_options::recursive);
  const auto import = [&] {
    return test::canopeer({"scene", "import", kWorld, "--model-path", models.string(), "--fruit",
                           kFruit, "--out", (directory / "out").string()});
  };
  fs::remove(models / "pepper_tall/materials/textures/leaf.png");
  const auto without_texture = import();
  EXPECT_EQ(without_texture.status, 0);
  EXPECT_NE(without_texture.err.find("leaf.png: not found"), std::string::npos)
      << without_texture.err;
  fs::remove_all(directory / "out");
  fs::remove(models / "pepper_tall/meshes/pepper_tall.dae");
  const auto without_mesh = import();
  EXPECT_EQ(without_mesh.status, 2);
  for (const char* word : {"pepper_tall/model.sdf:", "meshes/pepper_tall.dae", "no such file"}) {
    EXPECT_NE(without_mesh.err.find(word), std::string::npos) << without_mesh.err;
  }
  EXPECT_FALSE(fs::exists(directory / "out"));
  fs::remove_all(models / "pepper_tall");
  const auto without_model = import();
  EXPECT_EQ(without_model.status, 2);
  EXPECT_NE(without_model.err.find("model://pepper_tall"), std::string::npos) << without_model.err;
}

TEST(SceneImport, BadArgumentsAreUsageErrors) {
  const test::TemporaryDirectory directory;
  const std::string out = (directory / "out").string();
  EXPECT_EQ(test::canopeer({"scene", "import", kWorld}).status, 2);
  EXPECT_EQ(test::canopeer({"scene", "import", "no.world", "--fruit", "x", "--out", out}).status,
            2);
  const auto regex = test::canopeer({"scene", "import", kWorld, "--fruit", "(", "--out", out});
  EXPECT_EQ(regex.status, 2);
  EXPECT_NE(regex.err.find("no regular expression"), std::string::npos) << regex.err;
}

}  // namespace
}  // namespace canopeer
