#pragma once

#include <memory>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

struct ViewIkOptions {
  int rolls = 8;  ///< turns about the optical axis tried per view, evenly spread over 360°
};

/// Inverse kinematics of arms built like a UR: axes 2, 3, 4 parallel, each other neighbour pair at
/// right angles and intersecting. Immutable and safe to share between threads; results depend on
/// the arguments only.
class ArmIk {
 public:
  /// Recognises the arm from its joint axes (not from names) and proves the closed form against
  /// forward kinematics; says what does not fit otherwise.
  [[nodiscard]] static Expected<ArmIk> make(const RobotModel& robot);

  /// Appends every configuration within the limits that puts the camera at `T_base_camera` (up to
  /// eight), each joint at the 2π-equivalent nearest to `reference`. In a wrist singularity joint 6
  /// keeps its reference value. Appends nothing when the pose is out of reach.
  void solve(const Pose& T_base_camera, const Configuration& reference,
             std::vector<Configuration>& out) const;

  /// Replaces `out` by all configurations in which the camera, at `position` (arm base frame),
  /// looks at `target`, at any of the rolls; nearest to `reference` first (Σ|Δq|).
  void solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                  std::vector<Configuration>& out, const ViewIkOptions& options = {}) const;

 private:
  ArmIk() = default;

  // Denavit–Hartenberg form of the chain, frames 0 … 6: q_i = sign_i · (θ_i − offset_i).
  Pose T_0_base_ = Pose::Identity();
  Pose T_camera_6_ = Pose::Identity();
  double a2_ = 0.0;
  double a3_ = 0.0;
  double d4_ = 0.0;
  double d5_ = 0.0;
  double sign_[6] = {};
  double offset_[6] = {};
  Configuration lower_;
  Configuration upper_;
};

}  // namespace canopeer
