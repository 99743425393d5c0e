#pragma once

#include <cstdint>

#include "canopeer/robot/ik/ik_solver.h"

namespace canopeer {

/// Damped least squares for any arm (Sugihara, "Solvability-Unconcerned Inverse Kinematics by the
/// Levenberg–Marquardt Method", IEEE T-RO 2011). It starts from the reference, and from those of a
/// fixed table of configurations whose cameras are nearest to what is wanted. Views leave the roll
/// free: five equations instead of six. Joints at a limit stay there while the step leads outwards.
class NumericIk : public IkSolver {
 public:
  explicit NumericIk(const RobotModel& robot);

  [[nodiscard]] IkKind kind() const override { return IkKind::kNumeric; }
  void solve(const Pose& T_base_camera, const Configuration& reference,
             std::vector<Configuration>& out) const override;
  void solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                  std::vector<Configuration>& out, const ViewIkOptions& options) const override;

 private:
  struct Goal {
    Pose T_base_camera = Pose::Identity();
    bool any_roll = false;
  };
  template <int kEquations>
  bool converge(const Goal& goal, Configuration& q) const;
  void search(const Goal& goal, const Configuration& reference, int starts, int solutions,
              std::vector<Configuration>& out) const;
  int nearest_starts(const Goal& goal, int count, int* rows) const;

  RobotModel robot_;
  std::vector<Configuration> table_;
  // Cameras of the table: positions and optical axes, one array a coordinate.
  std::vector<float> camera_[6];
};

}  // namespace canopeer
