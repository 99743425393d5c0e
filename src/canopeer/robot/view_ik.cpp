#include "canopeer/robot/view_ik.h"

#include <algorithm>
#include <array>
#include <string>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"
#include "canopeer/robot/ik/closed_form_ik.h"
#include "canopeer/robot/ik/numeric_ik.h"

namespace canopeer {
namespace {

constexpr double kSelfTestPositionM = 1e-6;
constexpr double kSelfTestRotation = 1e-6;
constexpr int kSelfTests = 50;

/// Ties keep their order. Only the order of more than kInPlace configurations needs memory.
void sort_by_distance(const Configuration& reference, std::vector<Configuration>& configurations) {
  struct Key {
    double distance = 0.0;
    int from = 0;
    bool operator<(const Key& other) const {
      return distance != other.distance ? distance < other.distance : from < other.from;
    }
  };
  constexpr std::size_t kInPlace = 256;
  std::array<Key, kInPlace> few;
  std::vector<Key> many;
  const std::size_t count = configurations.size();
  if (count > kInPlace) many.resize(count);
  Key* const keys = count > kInPlace ? many.data() : few.data();
  for (std::size_t i = 0; i < count; ++i)
    keys[i] = {joint_distance(reference, configurations[i]), static_cast<int>(i)};
  std::sort(keys, keys + count);
  // The permutation, cycle by cycle.
  for (std::size_t i = 0; i < count; ++i) {
    if (keys[i].from < 0 || keys[i].from == static_cast<int>(i)) continue;
    const Configuration first = configurations[i];
    std::size_t to = i;
    while (keys[to].from != static_cast<int>(i)) {
      const auto from = static_cast<std::size_t>(keys[to].from);
      configurations[to] = configurations[from];
      keys[to].from = -1;
      to = from;
    }
    configurations[to] = first;
    keys[to].from = -1;
  }
}

ArmGeometry geometry_of(const RobotModel& robot) {
  const Configuration zero = Configuration::Zero(robot.dof());
  return {robot.arm_axes(zero), robot.T_base_camera(zero), robot.limits().lower,
          robot.limits().upper};
}

/// The solver must reach random configurations' camera poses, and the closed form return the
/// configurations themselves.
Expected<void> self_test(const IkSolver& ik, const RobotModel& robot) {
  Rng rng(1, "arm-ik-self-test");
  std::vector<Configuration> found;
  const bool closed = ik.kind() != IkKind::kNumeric;
  int reached_some = 0;
  for (int trial = 0; trial < kSelfTests; ++trial) {
    Configuration q(robot.dof());
    for (int i = 0; i < q.size(); ++i)
      q[i] = rng.uniform(robot.span().lower[i], robot.span().upper[i]);
    const Pose T = robot.T_base_camera(q);
    found.clear();
    ik.solve(T, q, found);
    bool itself = false;
    for (const Configuration& candidate : found) {
      const Pose reached = robot.T_base_camera(candidate);
      if ((reached.translation() - T.translation()).norm() > kSelfTestPositionM ||
          (reached.linear() - T.linear()).norm() > kSelfTestRotation)
        return fail("inverse kinematics: the closed form does not fit this arm");
      itself = itself || (candidate - q).lpNorm<Eigen::Infinity>() < 1e-5;
    }
    reached_some += found.empty() ? 0 : 1;
    if (closed && !itself)
      return fail("inverse kinematics: the closed form misses solutions of this arm");
  }
  if (reached_some < kSelfTests / 2)
    return fail("inverse kinematics: the numeric method finds no way to most poses of this arm");
  return {};
}

}  // namespace

std::string_view ik_kind_name(IkKind kind) {
  switch (kind) {
    case IkKind::kUrLike:
      return "closed form (built like a UR)";
    case IkKind::kSphericalWrist:
      return "closed form (spherical wrist)";
    case IkKind::kNumeric:
      break;
  }
  return "numeric";
}

Expected<ArmIk> ArmIk::make(const RobotModel& robot) {
  auto closed = ClosedFormIk::make(geometry_of(robot));
  if (!closed || !self_test(**closed, robot)) return make_numeric(robot);
  return ArmIk(std::shared_ptr<const IkSolver>(std::move(*closed)));
}

Expected<ArmIk> ArmIk::make_numeric(const RobotModel& robot) {
  const auto numeric = std::make_shared<const NumericIk>(robot);
  if (auto tested = self_test(*numeric, robot); !tested) return fail(tested.error().message);
  return ArmIk(numeric);
}

IkKind ArmIk::kind() const { return solver_->kind(); }
int ArmIk::sampled_joints() const { return solver_->sampled_joints(); }

void ArmIk::solve(const Pose& T_base_camera, const Configuration& reference,
                  std::vector<Configuration>& out) const {
  solver_->solve(T_base_camera, reference, out);
}

void ArmIk::solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                       std::vector<Configuration>& out, const ViewIkOptions& options) const {
  CANOPEER_CHECK(options.rolls > 0, "at least one roll");
  solver_->solve_view(position, target, reference, out, options);
  sort_by_distance(reference, out);
}

}  // namespace canopeer
