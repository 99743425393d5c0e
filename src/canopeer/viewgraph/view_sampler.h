#pragma once

#include <optional>

#include "canopeer/base/compute_cost.h"
#include "canopeer/base/rng.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/viewgraph/segment_frame.h"
#include "canopeer/viewgraph/target_sampler.h"
#include "canopeer/viewgraph/view_pose.h"

namespace canopeer {

/// How far from its target a view is drawn, and how often it is tried.
struct ViewSamplerOptions {
  double min_target_distance_m = 0.3;  ///< nearest camera position to its target
  double max_target_distance_m = 0.6;
  int max_tries =
      12;  ///< for one candidate of a kind: other targets and positions until a view is valid
  int max_draws = 400;        ///< (target, position) pairs drawn in a try until one is within the
                              ///< distances
  int max_state_checks = 12;  ///< arm configurations of one view tried for collisions
  int rolls = 8;              ///< turns about the optical axis tried; 1: the image is upright
};

/// Samples view poses: a camera position in the workspace, and an arm configuration that gets the
/// camera there free of collisions. From there the camera sees a target at the right distance,
/// unoccluded ([Zaenker23], section III-B).
class ViewSampler {
 public:
  /// Keeps pointers to all but the options; they must outlive the sampler.
  ViewSampler(const SegmentFrame& frame, const RobotModel& robot, const ArmIk& ik,
              const ViewSamplerOptions& options);

  /// The targets of the map's frontiers that a camera in the workspace can have in reach. Weights
  /// are the part of the workspace in the box around their reach.
  [[nodiscard]] TargetSampler targets_in_reach(const FrontierTargets& frontiers,
                                               double resolution_m,
                                               const TargetShares& shares) const;

  /// One candidate; nothing when no try passes all tests. Its kind is drawn once and kept. So the
  /// shares of the kinds hold among the views, not only among the tries (views of fruits fail most
  /// often). `targets` are those in reach. The arm configuration is the collision-free one nearest
  /// to home, so that neighbouring views are neighbours in joint space too. Thread-safe; `work` is
  /// counted in the call.
  [[nodiscard]] std::optional<ViewPose> sample(const VoxelMap& map, const CollisionChecker& checker,
                                               const TargetSampler& targets, Rng& rng,
                                               WorkMeter& work) const;

 private:
  struct Sight {
    Target target;
    Vec3 camera_world;
  };
  [[nodiscard]] std::optional<ViewPose> sample_once(const VoxelMap& map,
                                                    const CollisionChecker& checker,
                                                    const TargetSampler& targets, TargetKind kind,
                                                    Rng& rng, WorkMeter& work) const;
  /// Camera positions (base frame) in the workspace within the box around the reach of a target.
  [[nodiscard]] Box part_in_reach(const Vec3& target_world) const;
  [[nodiscard]] std::optional<Sight> draw_sight(const TargetSampler& targets, TargetKind kind,
                                                Rng& rng) const;
  [[nodiscard]] std::optional<Configuration> reach(const Sight& sight,
                                                   const CollisionChecker& checker,
                                                   WorkMeter& work) const;

  const SegmentFrame* frame_;
  const RobotModel* robot_;
  const ArmIk* ik_;
  ViewSamplerOptions options_;
  Pose T_base_world_;
};

}  // namespace canopeer
