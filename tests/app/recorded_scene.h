#pragma once

#include <filesystem>
#include <vector>

#include "ball_scene.h"
#include "canopeer/base/check.h"

namespace canopeer::test {

/// What a small camera saw of a scene from a few places, one second apart, as recordings on disk.
struct RecordedScene {
  std::vector<BallScene::View> views;

  static RecordedScene make(std::uint64_t seed, int count);
  /// Depth units of the sequences written below: fine, and room for all depths in range (3 m).
  static constexpr double kDepthUnits = 20000.0;

  /// depth.txt, rgb.txt (fruit red, all else green), groundtruth.txt with poses every half second
  /// (those in between are other views' and must not be taken), camera.yaml.
  void write_tum(const std::filesystem::path& directory) const;
  /// Clouds in the camera's frame. PLY with poses.txt, or PCD that say their viewpoint.
  void write_ply_folder(const std::filesystem::path& directory) const;
  void write_pcd_folder(const std::filesystem::path& directory) const;
};

}  // namespace canopeer::test
