#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/motion_judge.h"
#include "canopeer/sim/near_space.h"
#include "canopeer/viewgraph/segment_frame.h"

namespace canopeer {

/// Where the robot stands in a segment of a mission. Boxes, base and home as for its planner.
[[nodiscard]] SegmentFrame planned_frame(const RobotModel& robot, const SegmentPlan& plan,
                                         int index);

/// Draws arm configurations at one stop that touch neither the robot itself nor structure nor
/// plants. Const members are thread-safe; what they draw depends on the stream only.
class FreeViews {
 public:
  /// Fruits count as in range when the camera anywhere in the workspace has them between
  /// `near_m` and `far_m`. All that is handed in outlives it.
  FreeViews(const RobotModel& robot, const ArmIk& ik, const Scene& scene, const MotionJudge& judge,
            const SegmentFrame& frame, double near_m, double far_m);

  /// Whether a camera in the workspace may have a point (world) in range.
  [[nodiscard]] bool may_be_in_range(const Vec3& point_world) const;
  /// Centres of the counted fruits that a camera in the workspace may have in range, world.
  [[nodiscard]] const std::vector<Vec3>& fruits() const { return fruits_; }

  /// The camera in the workspace, uniform, at fruits()[fruit], within the range.
  [[nodiscard]] std::optional<Configuration> aimed(std::size_t fruit, Rng& rng) const;
  /// The camera in the workspace, at a point (world), uniform in direction and distance of those
  /// positions from which it is in sight.
  [[nodiscard]] std::optional<Configuration> at_point(
      const Vec3& target_world, const std::function<bool(const Vec3& from_world)>& in_sight,
      Rng& rng) const;
  /// The camera in the workspace and its axis, both uniform.
  [[nodiscard]] std::optional<Configuration> in_workspace(Rng& rng) const;
  /// The joints uniform within their limits, wherever that takes the camera.
  [[nodiscard]] std::optional<Configuration> anywhere(Rng& rng) const;

 private:
  [[nodiscard]] std::optional<Configuration> reach(const Vec3& position_base,
                                                   const Vec3& target_base) const;
  [[nodiscard]] bool is_free(const Configuration& q) const;

  const RobotModel& robot_;
  const ArmIk& ik_;
  const MotionJudge& judge_;
  SegmentFrame frame_;
  NearSpace space_;
  std::vector<Vec3> fruits_;
  double near_m_;
  double far_m_;
  Pose T_base_world_;
};

}  // namespace canopeer
