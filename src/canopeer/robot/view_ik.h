#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

class IkSolver;

/// How many ways of holding the camera are tried for a view.
struct ViewIkOptions {
  int rolls = 8;  ///< turns about the optical axis tried per view, evenly spread over 360°;
                  ///< numeric solutions leave the roll free and do not use it
  int numeric_starts = 12;    ///< where the numeric method starts from at most, per view
  int numeric_solutions = 6;  ///< it stops when it has so many, no two within 0.1 of each other
};

/// Which inverse kinematics an arm gets.
enum class IkKind { kUrLike, kSphericalWrist, kNumeric };
[[nodiscard]] std::string_view ik_kind_name(IkKind kind);

/// Inverse kinematics of any arm of up to kMaxArmJoints joints. The last six joints are solved in
/// closed form when their axes (not names) allow it. Such arms are built like a UR (axes 2, 3, 4
/// parallel), or have a spherical wrist behind a shoulder and elbow with parallel axes. Joints
/// before those six (a rail, say) are sampled. Every other arm is solved numerically. Immutable and
/// safe to share between threads; results depend on the arguments only. With vectors that have
/// room, nothing allocates.
class ArmIk {
 public:
  /// Recognises the arm and proves the solver against forward kinematics; an error says what an
  /// arm that no method solves looks like.
  [[nodiscard]] static Expected<ArmIk> make(const RobotModel& robot);
  /// The numeric method, whatever the arm.
  [[nodiscard]] static Expected<ArmIk> make_numeric(const RobotModel& robot);

  [[nodiscard]] IkKind kind() const;
  /// Joints that are sampled before the closed form is applied; 0 for numeric arms.
  [[nodiscard]] int sampled_joints() const;

  /// Appends configurations within the limits that put the camera at `T_base_camera`, revolute
  /// joints at the 2π-equivalent nearest to `reference`. Closed form: all of them (up to eight for
  /// each sampled rail position); numeric: those found from a few starts. In a wrist singularity
  /// the last joint keeps its reference value. Appends nothing when the pose is out of reach.
  void solve(const Pose& T_base_camera, const Configuration& reference,
             std::vector<Configuration>& out) const;

  /// Replaces `out` by configurations in which the camera, at `position` (arm base frame), looks at
  /// `target`; nearest to `reference` first (Σ|Δq|). Closed form: all, at each of the rolls.
  void solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                  std::vector<Configuration>& out, const ViewIkOptions& options = {}) const;

 private:
  explicit ArmIk(std::shared_ptr<const IkSolver> solver) : solver_(std::move(solver)) {}

  std::shared_ptr<const IkSolver> solver_;
};

}  // namespace canopeer
