// Depth images and poses in every tongue: the same map.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/map/map_file.h"
#include "inputs.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using test::input;

/// What `map fuse` made of a recording.
struct Fused {
  std::string bytes;  ///< of the .ot file
  VoxelMap map;
  std::string out, err;
};

Fused fuse(const fs::path& dataset, std::vector<std::string> options) {
  const test::TemporaryDirectory directory;
  const auto file = directory / "map.ot";
  options.insert(options.begin(),
                 {"map", "fuse", dataset.string(), "--out", file.string(), "--resolution", "0.05"});
  const auto result = test::canopeer(options);
  EXPECT_EQ(result.status, 0) << result.err;
  Fused fused{"", VoxelMap(), result.out, result.err};
  if (result.status != 0) return fused;
  fused.bytes = read_file(file).value();
  fused.map = read_map(file).value().map;
  return fused;
}

Fused fuse_room(const std::string& trajectory, std::vector<std::string> options = {}) {
  options.insert(options.end(), {"--trajectory", input("room/" + trajectory).string()});
  return fuse(input("room"), options);
}

/// A recording of one of the images of `inputs/no_depth/`, from the origin.
Fused fuse_image(const std::string& name, const std::string& camera = {}) {
  const test::TemporaryDirectory directory;
  fs::create_directories(directory / "depth");
  fs::copy_file(input("no_depth/" + name), directory / ("depth/1" + name.substr(name.find('.'))));
  EXPECT_TRUE(write_file(directory / "groundtruth.txt", "1 0 0 0 0 0 0 1\n"));
  const std::string lens = *read_file(input("no_depth/camera.yaml"));
  EXPECT_TRUE(write_file(directory / "camera.yaml", lens + camera));
  return fuse(directory / "", {});
}

std::set<std::array<int, 3>> occupied(const VoxelMap& map) {
  std::set<std::array<int, 3>> voxels;
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      if (map.occupancy(v) == Occupancy::occupied) voxels.insert({v.x(), v.y(), v.z()});
    });
  }
  return voxels;
}

TEST(DepthImages, WhateverMeansNoDepthIsNone) {
  const Fused zero = fuse_image("zero.png");
  EXPECT_GT(zero.map.occupied_voxels(), 80);
  for (const char* name :
       {"max.png", "zero_binary.pgm", "zero_text.pgm", "max_binary.pgm", "max_text.pgm"}) {
    EXPECT_TRUE(fuse_image(name).bytes == zero.bytes) << name;
  }
  const Fused far = fuse_image("far_plane.pgm");
  EXPECT_NE(far.err.find("max_depth_m: 10"), std::string::npos) << far.err;
  EXPECT_GT(far.map.observed_voxels(), zero.map.observed_voxels());
  const Fused limited = fuse_image("far_plane.pgm", "max_depth_m: 10\n");
  EXPECT_TRUE(limited.bytes == zero.bytes);
  EXPECT_EQ(limited.err.find("canopeer:"), std::string::npos) << limited.err;
}

TEST(Poses, EveryTongueGivesTheSameMap) {
  const Fused tum = fuse_room("groundtruth.txt");
  EXPECT_GT(tum.map.occupied_voxels(), 800);
  EXPECT_NE(tum.out.find("poses             timestamp tx ty tz qx qy qz qw\n"), std::string::npos);
  EXPECT_EQ(tum.err.find("canopeer:"), std::string::npos) << tum.err;
  for (const char* name : {"euroc.csv", "ros.csv", "without_stamps.txt", "counted.txt"}) {
    const Fused other = fuse_room(name);
    EXPECT_TRUE(other.bytes == tum.bytes) << name << other.err;
    EXPECT_NE(other.out.find("poses    "), std::string::npos);
  }
  // Matrices round differently.
  for (const char* name : {"kitti.txt", "redwood.log"}) {
    std::vector<std::array<int, 3>> different;
    const auto a = occupied(tum.map), b = occupied(fuse_room(name).map);
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                  std::back_inserter(different));
    EXPECT_LE(different.size(), 4U) << name;
  }
}

TEST(Poses, OfALeftHandedCameraAreMirrored) {
  const Fused right = fuse_room("groundtruth.txt");
  const Fused left =
      fuse_room("left_handed.txt", {"--camera", input("room/camera_y_up.yaml").string()});
  EXPECT_NE(left.err.find("y axis points up"), std::string::npos) << left.err;
  EXPECT_TRUE(left.bytes == right.bytes);
}

TEST(Poses, ThatMakeSenseInAnotherOrderOnlyAreRefused) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "map.ot";
  const auto refused = [&](const char* trajectory) {
    const auto result =
        test::canopeer({"map", "fuse", input("room").string(), "--out", out.string(),
                        "--trajectory", input(std::string("room/") + trajectory).string()});
    EXPECT_EQ(result.status, 2) << trajectory << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(out));
    return result.err;
  };
  const std::string w_first = refused("w_first.txt");
  EXPECT_NE(w_first.find("w_first.txt: the poses fit what was seen only when quaternions are read "
                         "as qw qx qy qz"),
            std::string::npos)
      << w_first;
  EXPECT_NE(w_first.find("# timestamp tx ty tz qw qx qy qz"), std::string::npos) << w_first;
  const std::string left_handed = refused("left_handed.txt");
  EXPECT_NE(left_handed.find("only when they are taken as left-handed"), std::string::npos)
      << left_handed;
  EXPECT_NE(left_handed.find("a negative fy_px"), std::string::npos) << left_handed;
  EXPECT_NE(refused("too_few.txt").find("5 poses without time stamps for 6 depth images"),
            std::string::npos);
}

TEST(Poses, WhoseOrderIsSaidAreNotRefusedForIt) {
  const test::TemporaryDirectory directory;
  const auto says = directory / "says.txt";
  ASSERT_TRUE(write_file(
      says, "# timestamp tx ty tz qx qy qz qw\n" + read_file(input("room/w_first.txt")).value()));
  const std::string err = fuse(input("room"), {"--trajectory", says.string()}).err;
  EXPECT_NE(err.find("says.txt: the poses do not fit what was seen"), std::string::npos) << err;
}

TEST(Poses, InMillimetresMakeANotice) {
  const std::string err = fuse_room("millimetres.txt").err;
  EXPECT_NE(err.find("the camera moves as none does"), std::string::npos) << err;
}

TEST(Poses, WithTheWrongDepthUnitDoNotFit) {
  const std::string err = fuse_room("groundtruth.txt", {"--depth-factor", "15000"}).err;
  EXPECT_NE(err.find("the poses do not fit what was seen"), std::string::npos) << err;
  const Fused far = fuse_room("groundtruth.txt", {"--depth-factor", "500"});
  EXPECT_NE(far.err.find("holds free space only"), std::string::npos) << far.err;
}

}  // namespace
}  // namespace canopeer
