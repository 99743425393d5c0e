#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/map/cloud_fusion.h"
#include "canopeer/map/map_file.h"
#include "canopeer/sensing/cloud_folder.h"
#include "canopeer/sensing/png.h"
#include "canopeer/sensing/tum_sequence.h"
#include "program.h"
#include "recorded_scene.h"
#include "same_map.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using test::RecordedScene;

VoxelMap empty_map() {
  VoxelMapOptions options;
  options.resolution_m = 0.02;
  return VoxelMap(options);
}

/// Runs `map fuse` at 2 cm and gives the map it wrote.
class MapFuse : public ::testing::Test {
 protected:
  VoxelMap fused(const fs::path& dataset, std::vector<std::string> options = {}) {
    const fs::path out = directory_ / "map.cmap";
    options.insert(options.begin(), {"map", "fuse", dataset.string(), "--out", out.string(),
                                     "--resolution", "0.02"});
    const auto result = test::canopeer(options);
    EXPECT_EQ(result.status, 0) << result.err;
    auto map = read_map(out);
    EXPECT_TRUE(map.has_value()) << map.error().message;
    return map ? map->map : VoxelMap();
  }

  /// Expects status 2, every one of `words` in one line of message, and no map.
  void expect_refused(const fs::path& dataset, const std::vector<std::string>& words,
                      std::vector<std::string> options = {}) {
    const fs::path out = directory_ / "refused.ot";
    options.insert(options.begin(), {"map", "fuse", dataset.string(), "--out", out.string()});
    const auto result = test::canopeer(options);
    EXPECT_EQ(result.status, 2) << result.err;
    for (const auto& word : words) {
      EXPECT_NE(result.err.find(word), std::string::npos)
          << "no '" << word << "' in: " << result.err;
    }
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(out));
    EXPECT_FALSE(half_written(out.parent_path()));
  }

  /// Files that were to be renamed when they are whole.
  static bool half_written(const fs::path& folder) {
    return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                       [](const auto& entry) { return entry.path().extension() == ".part"; });
  }

  void write(const fs::path& file, const std::string& text) {
    ASSERT_TRUE(write_file(file, text).has_value());
  }

  test::TemporaryDirectory directory_;
};

TEST_F(MapFuse, ATumSequenceBecomesTheMapOfItsFrames) {
  const RecordedScene scene = RecordedScene::make(1, 4);
  const fs::path dataset = directory_ / "tum";
  scene.write_tum(dataset);
  const VoxelMap map = fused(dataset);

  // From the same files by hand: the same to the bit.
  VoxelMap by_hand = empty_map();
  const auto sequence = open_tum_sequence(dataset);
  ASSERT_TRUE(sequence.has_value()) << sequence.error().message;
  ASSERT_EQ(sequence->frames.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    RgbdFrame frame = scene.views[i].frame;
    frame.T_world_camera = sequence->frames[i].T_world_camera;
    frame.depth = *read_depth_png(sequence->frames[i].depth, RecordedScene::kDepthUnits);
    EXPECT_TRUE(frame.T_world_camera.isApprox(scene.views[i].frame.T_world_camera, 1e-12));
    fuse(by_hand, frame, {});
  }
  expect_same_map(map, by_hand);

  // From the frames before they went to disk: but for the rounding of depth to 1/20 mm. What is too
  // far for the file is no depth there.
  VoxelMap direct = empty_map();
  for (const auto& view : scene.views) {
    RgbdFrame frame = view.frame;
    for (float& z : frame.depth.pixels()) z = z > 65535.0 / RecordedScene::kDepthUnits ? 0.0F : z;
    fuse(direct, frame, {});
  }
  std::int64_t different = 0;
  for (const BlockKey key : direct.block_keys()) {
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      different += direct.occupancy_log_odds(v) != map.occupancy_log_odds(v);
    });
  }
  EXPECT_LT(different, direct.observed_voxels() / 500);
}

TEST_F(MapFuse, OptionsPickFramesRangeAndFruit) {
  const RecordedScene scene = RecordedScene::make(2, 4);
  const fs::path dataset = directory_ / "tum";
  scene.write_tum(dataset);
  const auto sequence = open_tum_sequence(dataset);
  ASSERT_TRUE(sequence.has_value());
  VoxelMap by_hand = empty_map();
  FusionOptions options;
  options.max_range_m = 1.1;
  for (const std::size_t i : {0U, 3U}) {
    RgbdFrame frame = scene.views[i].frame;
    frame.T_world_camera = sequence->frames[i].T_world_camera;
    frame.depth = *read_depth_png(sequence->frames[i].depth, RecordedScene::kDepthUnits);
    fuse(by_hand, frame, {}, options);
  }
  expect_same_map(fused(dataset, {"--every", "3", "--max-range", "1.1"}), by_hand);

  RecordedScene holed = scene;
  for (int v = 0; v < 20; ++v) {
    for (int u = 0; u < 20; ++u) holed.views[0].frame.depth.at(u, v) = 0.0F;
  }
  holed.write_tum(directory_ / "holed");
  EXPECT_GT(fused(directory_ / "holed", {"--clear-no-return"}).observed_voxels(),
            fused(directory_ / "holed").observed_voxels());

  const VoxelMap with_roi = fused(dataset, {"--roi", "color"});
  EXPECT_GT(with_roi.roi_voxels(), 20);
  EXPECT_LT(with_roi.roi_voxels(), with_roi.occupied_voxels() / 5);

  const CameraIntrinsics& k = scene.views[0].frame.intrinsics;
  const std::string same_camera = std::to_string(k.fx) + "," + std::to_string(k.fy) + "," +
                                  std::to_string(k.cx - 0.5) + "," + std::to_string(k.cy - 0.5);
  fs::remove(dataset / "camera.yaml");
  const VoxelMap other = fused(dataset, {"--intrinsics", same_camera, "--depth-factor", "20000"});
  EXPECT_NEAR(static_cast<double>(other.occupied_voxels()),
              static_cast<double>(with_roi.occupied_voxels()), 10.0);
}

TEST_F(MapFuse, FoldersOfCloudsBecomeTheMapOfTheirClouds) {
  const RecordedScene scene = RecordedScene::make(3, 3);
  const fs::path ply = directory_ / "ply";
  const fs::path pcd = directory_ / "pcd";
  scene.write_ply_folder(ply);
  scene.write_pcd_folder(pcd);
  for (const fs::path& dataset : {ply, pcd}) {
    const auto folder = open_cloud_folder(dataset);
    ASSERT_TRUE(folder.has_value()) << folder.error().message;
    VoxelMap by_hand = empty_map();
    for (std::size_t i = 0; i < folder->frames.size(); ++i) {
      const auto cloud = load_cloud(*folder, i);
      ASSERT_TRUE(cloud.has_value()) << cloud.error().message;
      CloudScan scan;
      scan.points = cloud->file.cloud.points;
      scan.roi_confidence = cloud->file.roi_confidence;
      scan.T_world_points = cloud->T_world_points;
      fuse_cloud(by_hand, scan);
    }
    const VoxelMap map = fused(dataset);
    expect_same_map(map, by_hand);
    EXPECT_EQ(map.roi_voxels() > 0, dataset == pcd);

    // The exact mode on the frames themselves: but for clouds in single precision.
    VoxelMap direct = empty_map();
    for (const auto& view : scene.views) fuse_exact(direct, view.frame, {});
    EXPECT_NEAR(static_cast<double>(direct.observed_voxels()),
                static_cast<double>(map.observed_voxels()), 10.0);
    EXPECT_NEAR(static_cast<double>(direct.occupied_voxels()),
                static_cast<double>(map.occupied_voxels()), 10.0);
  }
}

TEST_F(MapFuse, AMapThatStaysEmptyIsWarnedOf) {
  const fs::path dataset = directory_ / "clouds";
  fs::create_directory(dataset);
  for (const char* name : {"a.ply", "b.ply"}) {
    write(dataset / name,
          "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
          "property float z\nend_header\nnan nan nan\nnan 0 1\n");
  }
  write(dataset / "poses.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  const fs::path out = directory_ / "map.cmap";
  const auto result =
      test::canopeer({"map", "fuse", dataset.string(), "--out", out.string(), "--quiet"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "canopeer: warning: " + out.string() +
                            " is empty: none of the 2 frames of " + dataset.string() +
                            " has a pixel or point with a finite distance\n");
  EXPECT_TRUE(fs::exists(out));
}

TEST_F(MapFuse, AnyNumberOfThreadsWritesTheSameFile) {
  RecordedScene::make(4, 3).write_pcd_folder(directory_ / "pcd");
  const auto bytes = [&](const std::string& threads) {
    const auto map = fused(directory_ / "pcd", {"--threads", threads});
    return read_file(directory_ / "map.cmap").value_or("");
  };
  const std::string one = bytes("1");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == bytes("3"));
}

TEST_F(MapFuse, FramesWithoutAPoseArePassedOverOrRefused) {
  const RecordedScene scene = RecordedScene::make(5, 3);
  const fs::path dataset = directory_ / "tum";
  scene.write_tum(dataset);
  std::string poses = *read_file(dataset / "groundtruth.txt");
  poses.resize(poses.find("\n1.875") + 1);  // the third frame's poses are cut off
  write(dataset / "groundtruth.txt", poses);
  const fs::path out = directory_ / "map.ot";
  const auto result = test::canopeer({"map", "fuse", dataset.string(), "--out", out.string()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("1 of 3 frames have no pose"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("frames            2"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("frame 2/2"), std::string::npos) << "plain lines: " << result.err;
  expect_refused(dataset, {"1 of 3 frames", "2.000000 s"}, {"--strict"});
}

TEST_F(MapFuse, BadRecordingsAreNamedWithFileAndLine) {
  const fs::path dataset = directory_ / "tum";
  RecordedScene::make(6, 2).write_tum(dataset);
  expect_refused(directory_ / "nowhere", {"nowhere", "depth.txt"});
  fs::create_directories(directory_ / "empty");
  expect_refused(directory_ / "empty", {"empty", ".ply", "depth.txt"});

  const std::string camera = *read_file(dataset / "camera.yaml");
  write(dataset / "camera.yaml", "fx: 100\n");
  expect_refused(dataset, {"camera.yaml:1", "fx_px"});
  write(dataset / "camera.yaml", camera + "skew: 1\n");
  expect_refused(dataset, {"camera.yaml:8", "skew"});
  fs::remove(dataset / "camera.yaml");
  expect_refused(dataset, {"--intrinsics", "camera.yaml"});
  write(dataset / "camera.yaml", camera + "\n");

  const std::string color = *read_file(dataset / "rgb.txt");
  write(dataset / "rgb.txt", "900 rgb/0.png\n");
  expect_refused(dataset, {"rgb.txt", "--max-difference"}, {"--roi", "color"});
  write(dataset / "rgb.txt", color);

  const std::string poses = *read_file(dataset / "groundtruth.txt");
  write(dataset / "groundtruth.txt", poses + "3 1 2\n");
  expect_refused(dataset, {"groundtruth.txt:6", "timestamp tx ty tz qx qy qz qw"});
  write(dataset / "groundtruth.txt", "-0.1 1e9 0 0 0 0 0 1\n1.1 1e9 0 0 0 0 0 1\n");
  expect_refused(dataset, {"0.png", "m from the origin"}, {"--max-gap", "2"});
  write(dataset / "groundtruth.txt", poses);

  const std::string image = *read_file(dataset / "depth/1.png");
  write(dataset / "depth/1.png", image.substr(0, image.size() / 2));
  expect_refused(dataset, {"depth/1.png", "cut off"}, {"--quiet"});
  fs::remove(dataset / "depth/1.png");
  expect_refused(dataset, {"depth.txt:3", "1.png"});
}

TEST_F(MapFuse, WhereTheMapCannotGoIsSaidBeforehand) {
  const fs::path dataset = directory_ / "ply";
  RecordedScene::make(7, 1).write_ply_folder(dataset);
  for (const char* out : {"no/such/folder/map.ot", "map.obj", "map"}) {
    const auto result = test::canopeer({"map", "fuse", dataset.string(), "--out", out});
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_NE(result.err.find(out), std::string::npos) << result.err;
  }
}

TEST_F(MapFuse, InterruptedItLeavesTheMapSoFar) {
  const fs::path dataset = directory_ / "tum";
  RecordedScene::make(8, 1).write_tum(dataset);
  std::string depth;
  std::string poses;
  for (int i = 0; i < 20000; ++i) {  // the same image again and again: minutes of work
    depth += std::to_string(i) + " depth/0.png\n";
    poses += std::to_string(i) + " 0 0 0 0 0 0 1\n";
  }
  write(dataset / "depth.txt", depth + "90000 depth/0.png\n");  // passed over, and said so
  write(dataset / "groundtruth.txt", poses);
  const fs::path out = directory_ / "map.cmap";
  const auto result = test::canopeer_interrupted_when_it_speaks(
      {"map", "fuse", dataset.string(), "--out", out.string()});
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
  const auto map = read_map(out);
  EXPECT_TRUE(map.has_value()) << map.error().message;
  EXPECT_FALSE(half_written(out.parent_path()));
}

TEST(MapConvert, GoesFromFormatToFormatAndBack) {
  const test::TemporaryDirectory directory;
  const VoxelMap map = BallScene::map(1, 2);
  ASSERT_TRUE(write_map(map, directory / "a.cmap").has_value());
  const auto convert = [&](const char* in, const char* out) {
    const auto result =
        test::canopeer({"map", "convert", (directory / in).string(), (directory / out).string()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  EXPECT_NE(convert("a.cmap", "b.ot").find("b_roi.ot"), std::string::npos);
  convert("b.ot", "c.cmap");
  expect_same_map(read_map(directory / "c.cmap")->map, map);
  convert("a.cmap", "d.bt");
  convert("d.bt", "e.cmap");
  EXPECT_EQ(read_map(directory / "e.cmap")->map.roi_voxels(), map.roi_voxels());
  convert("e.cmap", "f.ply");
  EXPECT_TRUE(fs::exists(directory / "f_roi.ply"));
}

TEST(MapInfo, SaysWhatIsInAMap) {
  const test::TemporaryDirectory directory;
  ASSERT_TRUE(
      write_map(map_of({{0, 0, 0}, {-10, 0, 0}}, {{1, 0, 0}}, {{1, 0, 0}}), directory / "map.ot")
          .has_value());
  const auto result = test::canopeer({"map", "info", (directory / "map.ot").string()});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* part :
       {"OctoMap", "map_roi.ot", "0.01 m", "3 (3e-06 m³): 1 occupied, 2 free",
        "ROI voxels        1", "blocks            2", "x -0.100 … 0.020 m", "memory"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " in:\n" << result.out;
  }
}

TEST(MapInfo, RefusesWhatIsNoMap) {
  const test::TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory / "text.ot", "hello\n").has_value());
  const auto bytes = [&] {
    EXPECT_TRUE(write_map(BallScene::map(1, 1), directory / "whole.cmap").has_value());
    return *read_file(directory / "whole.cmap");
  }();
  ASSERT_TRUE(write_file(directory / "cut.cmap", bytes.substr(0, 1000)).has_value());
  for (const char* name : {"text.ot", "cut.cmap", "missing.bt"}) {
    const auto result = test::canopeer({"map", "info", (directory / name).string()});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
    EXPECT_TRUE(result.out.empty());
  }
}

}  // namespace
}  // namespace canopeer
