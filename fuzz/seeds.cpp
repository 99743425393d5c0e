// fuzz_seeds DIR writes small valid files for the fuzz targets to start from, into DIR/TARGET/.
#include <cstdio>
#include <filesystem>

#include "all_messages.h"
#include "ball_scene.h"
#include "canopeer/base/atomic_file.h"
#include "canopeer/cdr/cdr.h"
#include "canopeer/map/cmap_file.h"
#include "canopeer/map/files/map_cloud.h"
#include "canopeer/map/octomap_file.h"
#include "canopeer/scene/scene_file.h"
#include "canopeer/sensing/png.h"

namespace {

namespace fs = std::filesystem;
using namespace canopeer;

constexpr char kPcdHeader[] =
    "VERSION 0.7\nFIELDS x y z rgb roi\nSIZE 4 4 4 4 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH "
    "1\nHEIGHT 1\nVIEWPOINT 0 0 1 1 0 0 0\nPOINTS 1\nDATA ";
constexpr char kPlyText[] =
    "ply\nformat ascii 1.0\nelement other 1\nproperty list uchar int a\nelement vertex 1\nproperty "
    "float x\nproperty double y\nproperty short z\nproperty uchar red\nend_header\n2 1 2\n1 2 3 "
    "4\n";

/// An empty message of each type, its number in front (cdr_fuzz.cpp).
Expected<void> write_messages(const fs::path& folder) {
  Expected<void> result;
  std::string number(1, '\0');
  ros::for_each_message([&](const auto& message) {
    const ros::Payload payload = ros::to_cdr(message);
    const std::string bytes = number + std::string(payload.begin(), payload.end());
    if (result) result = write_file(folder / std::to_string(number[0]), bytes);
    ++number[0];
  });
  return result;
}

/// A box of a fruit with a picture on it.
Scene small_scene() {
  Scene scene;
  scene.name = "box";
  scene.parts.emplace_back();
  ScenePart& part = scene.parts.back();
  part.mesh = make_box(Box(Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1)));
  part.kind = PartClass::fruit;
  part.fruit = 0;
  part.uv.resize(part.mesh.vertices.size(), Eigen::Vector2f::Zero());
  Texture texture;
  texture.color = ColorImage(2, 2);
  part.texture = std::make_shared<Texture>(texture);
  scene.fruits.emplace_back();
  scene.models.push_back({scene.parts});
  scene.instances.emplace_back();
  return scene;
}

bool write_all(const fs::path& root) {
  for (const char* target :
       {"cdr", "octomap", "cmap", "cloud", "png", "scene_file", "trajectory"}) {
    fs::create_directories(root / target);
  }
  const VoxelMap map = BallScene::map(1, 1, 0.2);
  const std::string twenty(20, '\x01');
  const std::string packed = std::string("\x16\0\0\0\x14\0\0\0\x13", 9) + twenty;
  DepthImage depth(7, 5, 1.0F);
  Expected<void> results[] = {
      write_messages(root / "cdr"),
      write_ot(map, root / "octomap/full.ot"),
      write_roi_bt(map, root / "octomap/binary.bt"),
      write_cmap(map, root / "cmap/map.cmap"),
      write_ply(root / "cloud/map.ply", roi_cloud(map)),
      write_file(root / "cloud/text.ply", kPlyText),
      write_file(root / "cloud/text.pcd", std::string(kPcdHeader) + "ascii\n1 2 3 4 5\n"),
      write_file(root / "cloud/binary.pcd", std::string(kPcdHeader) + "binary\n" + twenty),
      write_file(root / "cloud/packed.pcd",
                 std::string(kPcdHeader) + "binary_compressed\n" + packed),
      write_file(root / "cloud/table.csv", "\xEF\xBB\xBFx;y;z;rgb\n0,5;1;\"2\";#ff0000\n"),
      write_file(root / "cloud/table.pts", "2\n1 2 3 40 255 0 0\n2 3 4 40 255 0 0\n"),
      write_depth_png(root / "png/depth.png", depth, 5000.0),
      write_file(root / "png/binary.pgm", "P5\n2 1\n65535\nabcd"),
      write_file(root / "png/text.pgm", "P2 # mm\n2 1\n65535\n1500 65535\n"),
      write_scene_file(root / "scene_file/box.cscene", small_scene()),
      write_png(root / "png/color.png", ColorImage(7, 5)),
      write_file(root / "trajectory/poses.txt", "# t\n0 1 2 3 0 0 0 1\n1.5 1 2 3 0 0 1 0\n"),
      write_file(root / "trajectory/euroc.csv",
                 "#timestamp [ns], p_x [m], p_y [m], p_z [m], q_w [], q_x [], q_y [], q_z []\n"
                 "1000000000,1,2,3,1,0,0,0\n"),
      write_file(root / "trajectory/matrices.log", "0 0 1\n1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n"),
      write_file(root / "trajectory/list.txt", "1.25 depth/a.png\n"),
      write_file(root / "trajectory/pairs.txt", "1.25 depth/a.png 1.26 rgb/a.png\n")};
  for (const auto& result : results) {
    if (!result) std::fprintf(stderr, "fuzz_seeds: %s\n", result.error().message.c_str());
    if (!result) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds DIR\n");
    return 2;
  }
  return write_all(argv[1]) ? 0 : 1;
}
