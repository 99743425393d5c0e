#include "canopeer/bounds/visibility/view_sampling.h"

#include <cmath>
#include <numbers>
#include <string>

#include "canopeer/robot/arm_reach.h"

namespace canopeer {
namespace {

constexpr double kCellM = 0.01;    // of the quick look at what is near
constexpr int kTries = 8;          // positions, directions or joints until one is free
constexpr int kDraws = 64;         // positions until one is in range
constexpr int kSights = 512;       // positions round a point until it is in sight, seldom so many
constexpr double kOffAxis = 0.45;  // tangent
constexpr int kStates = 12;        // ways of holding the camera that are looked at for one view

Vec3 point_in(const Box& box, Rng& rng) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = rng.uniform(box.min()[axis], box.max()[axis]);
  return p;
}

Vec3 direction(Rng& rng) {
  const double z = rng.uniform(-1.0, 1.0);
  const double turn = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Whether a point is no farther from the box than far_m.
bool near_box(const Box& box, const Vec3& p, double far_m) {
  return box.squaredExteriorDistance(p) <= far_m * far_m;
}

}  // namespace

SegmentFrame planned_frame(const RobotModel& robot, const SegmentPlan& plan, int index) {
  SegmentFrame frame;
  frame.index = index;
  frame.trolley = plan.trolley;
  frame.T_world_base = robot.T_world_base(plan.trolley);
  frame.workspace_base = robot.workspace(plan.side);
  frame.sampling_region_world = transformed(robot.sampling_region(plan.side), frame.T_world_base);
  frame.home = robot.home("side_" + std::to_string(plan.side));
  return frame;
}

FreeViews::FreeViews(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                     const MotionJudge& judge, const SegmentFrame& frame, double near_m,
                     double far_m)
    : robot_(robot),
      ik_(ik),
      judge_(judge),
      frame_(frame),
      space_(robot, scene, frame.trolley, kCellM),
      near_m_(near_m),
      far_m_(far_m),
      T_base_world_(frame.T_world_base.inverse(Eigen::Isometry)) {
  for (const FruitTruth& fruit : scene.fruits) {
    if (fruit.counted && may_be_in_range(fruit.centre)) fruits_.push_back(fruit.centre);
  }
}

bool FreeViews::may_be_in_range(const Vec3& point_world) const {
  return near_box(frame_.workspace_base, T_base_world_ * point_world, far_m_);
}

std::optional<Configuration> FreeViews::aimed(std::size_t fruit, Rng& rng) const {
  const Vec3 target = T_base_world_ * fruits_[fruit];
  const Vec3 reach_m = Vec3::Constant(far_m_);
  const Box part = frame_.workspace_base.intersection(Box(target - reach_m, target + reach_m));
  for (int i = 0; i < kTries; ++i) {
    Vec3 position = point_in(part, rng);
    for (int k = 0; k < kDraws; ++k) {
      const double d = (position - target).norm();
      if (d >= near_m_ && d <= far_m_) break;
      position = point_in(part, rng);
    }
    if (auto q = reach(position, target)) return q;
  }
  return std::nullopt;
}

std::optional<Configuration> FreeViews::at_point(const Vec3& target_world,
                                                 const std::function<bool(const Vec3&)>& in_sight,
                                                 Rng& rng) const {
  const Vec3 target = T_base_world_ * target_world;
  const double reach_m = arm_reach_m(robot_);
  int tries = 0;
  for (int k = 0; k < kSights && tries < kTries; ++k) {
    const double distance = rng.uniform(near_m_, far_m_);
    const Vec3 position = target + distance * direction(rng);
    const bool inside = frame_.workspace_base.contains(position);
    if (!inside && (position.norm() > reach_m || !rng.chance(0.3))) continue;
    if (!in_sight(frame_.T_world_base * position)) continue;
    const Vec3 axis = target + rng.uniform(0.0, kOffAxis) * distance * direction(rng);
    if (auto q = reach(position, axis)) return q;
    ++tries;
  }
  return std::nullopt;
}

std::optional<Configuration> FreeViews::in_workspace(Rng& rng) const {
  for (int i = 0; i < kTries; ++i) {
    const Vec3 position = point_in(frame_.workspace_base, rng);
    if (auto q = reach(position, position + direction(rng))) return q;
  }
  return std::nullopt;
}

std::optional<Configuration> FreeViews::anywhere(Rng& rng) const {
  const JointLimits& span = robot_.span();
  for (int i = 0; i < kTries; ++i) {
    Configuration q(robot_.dof());
    for (int k = 0; k < q.size(); ++k) q[k] = rng.uniform(span.lower[k], span.upper[k]);
    if (is_free(q)) return q;
  }
  return std::nullopt;
}

/// The free way of holding the camera nearest to home, as planners have it. The exact judge is
/// asked only where the quick look calls none of them free.
std::optional<Configuration> FreeViews::reach(const Vec3& position_base,
                                              const Vec3& target_base) const {
  thread_local std::vector<Configuration> ways;  // keeps its room from call to call
  ik_.solve_view(position_base, target_base, frame_.home, ways);
  if (ways.size() > kStates) ways.resize(kStates);
  for (const Configuration& q : ways) {
    if (space_.surely_free(q)) return q;
  }
  if (ways.empty()) return std::nullopt;
  // While the judge waits for others, this thread may take up another sample.
  const Configuration first = ways.front();
  return is_free(first) ? std::optional(first) : std::nullopt;
}

bool FreeViews::is_free(const Configuration& q) const {
  return space_.surely_free(q) || judge_.free({q}, frame_.trolley);
}

}  // namespace canopeer
