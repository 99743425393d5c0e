#pragma once

#include <array>
#include <memory>
#include <span>

#include "canopeer/base/expected.h"
#include "canopeer/robot/ik/ik_solver.h"

namespace canopeer {

using SixAngles = std::array<double, 6>;

/// A closed form for six revolute joints.
class SixJointForm {
 public:
  static constexpr int kMaxBranches = 8;

  virtual ~SixJointForm() = default;
  [[nodiscard]] virtual IkKind kind() const = 0;
  /// All configurations (angles modulo 2π, limits not looked at) that put the camera at
  /// `T_base_camera`; returns how many. Where the last angle is free it is `last_reference`.
  virtual int branches(const Pose& T_base_camera, double last_reference,
                       std::array<SixAngles, kMaxBranches>& out) const = 0;
};

/// Arms built like a UR: axes 2, 3, 4 parallel, each other neighbour pair at right angles and
/// meeting. `geometry` has six joints. The error says what does not fit.
[[nodiscard]] Expected<std::unique_ptr<SixJointForm>> make_ur_form(const ArmGeometry& geometry);

/// Arms whose axes 4, 5, 6 meet in one point at right angles, with axis 2 at right angles to axis 1
/// and parallel to axis 3. Offsets between them are free. As in Brandstötter, Angerer, Hofbaur, "An
/// Analytical Solution of the Inverse Kinematics Problem of Industrial Serial Manipulators with an
/// Ortho-parallel Basis and a Spherical Wrist", 2014, here without a fixed zero pose.
[[nodiscard]] Expected<std::unique_ptr<SixJointForm>> make_spherical_wrist_form(
    const ArmGeometry& geometry);

/// A closed form for the last six joints, with those before them sampled.
class ClosedFormIk : public IkSolver {
 public:
  /// `geometry` of all joints, six or more.
  [[nodiscard]] static Expected<std::unique_ptr<IkSolver>> make(const ArmGeometry& geometry);

  [[nodiscard]] IkKind kind() const override { return form_->kind(); }
  [[nodiscard]] int sampled_joints() const override { return leads_; }
  void solve(const Pose& T_base_camera, const Configuration& reference,
             std::vector<Configuration>& out) const override;
  void solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                  std::vector<Configuration>& out, const ViewIkOptions& options) const override;

 private:
  ClosedFormIk() = default;
  void solve_tail(const Pose& T_tail_camera, const Configuration& reference,
                  std::vector<Configuration>& out) const;
  void solve_rolls(const Pose& T_tail_camera, const Configuration& reference, int rolls,
                   std::vector<Configuration>& out) const;
  bool fit(const SixAngles& angles, int joints, const Configuration& reference,
           Configuration& q) const;
  template <typename Solve>
  void for_each_lead(const Configuration& reference, Solve&& solve) const;

  std::unique_ptr<SixJointForm> form_;
  ArmGeometry geometry_;
  int leads_ = 0;
  std::vector<Configuration> lead_samples_;
  /// ±1: the camera looks along the last joint's axis, so that a roll is a turn of that joint; 0:
  /// it does not.
  double roll_sign_ = 0.0;
};

}  // namespace canopeer
