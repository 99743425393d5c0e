#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/bounds/view_pool.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer {

/// How thoroughly views are sampled. All limits are counts, so a pool depends on world, mission and
/// these only.
struct PoolOptions {
  int image_width = 160;    ///< pixels; field of view and range are the camera's
  double patch_m = 0.01;    ///< side of a square as large as a patch
  int aimed = 20;           ///< views aimed at each fruit in range of a segment, at least
  double seen_once = 0.01;  ///< views are sampled until no larger share of the patches is
  int batch = 1000;         ///< views until that is looked at, besides those aimed at patches
  int most = 3000;          ///< the same of a segment, at most; it ends then whatever is seen once
  int again = 6;            ///< rounds through all segments for what is still seen once or never
  double near_rad = 1.0;    ///< a view that shows less than one so near is not kept (Σ|Δq|)
  int keep = 2500;          ///< views kept a segment, about
  std::uint64_t seed = 1;
  /// Of the world (world_hash()): part of ViewPool::key.
  std::uint64_t world = 0;
  /// File that says how far the sampling is, so that the same call goes on after a stop; it goes
  /// when the pool is whole. Empty: none.
  std::filesystem::path checkpoint{};

  [[nodiscard]] Expected<void> validate() const;
};

/// How far a pool is.
struct PoolProgress {
  double share = 0.0;  ///< 0 … 1; a guess, as segments may end early
  int segment = 0;     ///< under way
  int segments = 0;
  PoolCourse course;  ///< of it
  bool segment_done = false;
  int again = 0;  ///< the round through all segments, from 1; `course` is then that of the pool
};

/// Who is told and asked after each batch; both may be empty.
struct PoolCallbacks {
  std::function<void(const PoolProgress&)> progress{};
  std::function<bool()> stop{};
};

/// Samples views segment by segment: arm configurations that touch nothing, half and more of them
/// aimed at each counted fruit that may be in range, the others with the camera anywhere in the
/// workspace or the joints anywhere within their limits (RIVALS: uniform, and aimed). Each is
/// looked from at the true scene by a pinhole, as far as the fruit map takes pixels: at 160 pixels'
/// width, which patch each shows. After each batch one view more is aimed at each patch that one
/// view or none has shown, along a free line of sight, with the patch anywhere near the axis. A
/// segment ends when the share of its patches that one view only has shown is small enough (of
/// uniform samples it estimates the chance that the next sees a new one, Good 1953). Then all
/// segments aim again at what the whole pool has shown once or never.
///
/// `judge` is of the same robot and scene. The result depends on the arguments, not on the number
/// of threads or on stops. The error: the options, or a stop (what was sampled is in the
/// checkpoint then), or the checkpoint cannot be written.
[[nodiscard]] Expected<ViewPool> build_view_pool(const RobotModel& robot, const ArmIk& ik,
                                                 const Scene& scene, const MotionJudge& judge,
                                                 const MissionOptions& mission,
                                                 const CameraIntrinsics& camera,
                                                 const PoolOptions& options,
                                                 const PoolCallbacks& callbacks = {});

/// What a pool depends on, as text: pools with the same key are the same pool.
[[nodiscard]] std::string pool_key(const MissionOptions& mission, const CameraIntrinsics& camera,
                                   const PoolOptions& options);

/// The camera that pools are sampled with.
[[nodiscard]] CameraIntrinsics pool_camera(const MissionOptions& mission,
                                           const CameraIntrinsics& camera, int image_width);

}  // namespace canopeer
