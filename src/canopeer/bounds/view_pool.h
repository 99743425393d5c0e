#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// The surfaces of the counted fruits, cut into patches of about the same size.
struct FruitPatches {
  double patch_m = 0.01;        ///< side of a square as large as a patch, about
  std::vector<int> fruit;       ///< by patch: FruitTruth::id
  std::vector<float> area_cm2;  ///< by patch
  int fruits_total = 0;         ///< counted ones
  double area_total_cm2 = 0.0;  ///< of their whole surface

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(patch_m, fruit, area_cm2, fruits_total, area_total_cm2);
  }
};

/// A configuration, free of collisions with robot, structure and plants, and what a camera sees
/// there.
struct PoolView {
  Configuration q;
  Pose T_world_camera = Pose::Identity();
  std::vector<std::uint32_t> patches;  ///< seen by a pixel or more; ascending

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(q, T_world_camera, patches);
  }
};

/// How far the sampling of a segment was after a batch.
struct PoolCourse {
  int segment = 0;
  std::int64_t sampled = 0;     ///< free configurations of this segment so far
  int fruits = 0;               ///< of which a patch or more was seen there
  std::uint32_t patches = 0;    ///< seen there
  std::uint32_t seen_once = 0;  ///< of these: by one sample only
  double area_cm2 = 0.0;        ///< of the patches seen there

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(segment, sampled, fruits, patches, seen_once, area_cm2);
  }
};

/// Which patches of which fruits can be seen from where, segment by segment: what all ceilings,
/// plans and bounds of a mission are made from.
struct ViewPool {
  FruitPatches patches;
  /// By segment of the mission; the first view of each is that at home. Views that show nothing are
  /// left out.
  std::vector<std::vector<PoolView>> segments;
  std::int64_t sampled = 0;  ///< free configurations looked at, those left out included
  /// By patch: how many of them show it.
  std::vector<std::uint32_t> times_seen;
  std::vector<PoolCourse> course;  ///< by segment and batch
  std::string key;                 ///< of world, segments, camera and options; see pool_key()

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(patches, segments, sampled, times_seen, course, key);
  }
};

/// When a fruit counts as one that its seen patches let be found: so much of its surface was seen,
/// at least. Smaller pieces the fruit map does not report.
struct FindRule {
  double min_area_cm2 = 3.0;  ///< what bounds go by; plans go by more (decision 111)
};

}  // namespace canopeer
