#include "canopeer/robot/robot_survey.h"

#include <algorithm>
#include <map>

#include "canopeer/base/rng.h"
#include "canopeer/robot/collision/convex_gap.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"

namespace canopeer {
namespace {

constexpr double kNearest = 0.3;  // m, camera to target
constexpr double kFarthest = 0.6;

Configuration draw_configuration(const RobotModel& robot, Rng& rng) {
  Configuration q(robot.dof());
  for (int i = 0; i < q.size(); ++i)
    q[i] = rng.uniform(robot.span().lower[i], robot.span().upper[i]);
  return q;
}

Vec3 draw_point(const Box& box, Rng& rng) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = rng.uniform(box.min()[axis], box.max()[axis]);
  return p;
}

std::size_t part_of(const Box& box, const Vec3& p) {
  const Eigen::Array3i part =
      ((p - box.min()).cwiseQuotient(box.sizes()) * 3.0).array().floor().cast<int>().max(0).min(2);
  return static_cast<std::size_t>(part.x() + 3 * part.y() + 9 * part.z());
}

TrolleyState draw_trolley(const RobotModel& robot, Rng& rng) {
  return {rng.uniform(robot.travel_axis().lower, robot.travel_axis().upper),
          rng.uniform(robot.lift_axis().lower, robot.lift_axis().upper)};
}

bool solids_touch(const Link& a, const Pose& T_world_a, const Link& b, const Pose& T_world_b) {
  const double padding = CollisionOptions().self_padding_m;
  for (const CollisionShape& of_a : a.collision) {
    const Pose T_shape_world = (T_world_a * of_a.T_link_shape).inverse();
    for (const CollisionShape& of_b : b.collision) {
      if (convex_gap(of_a, of_b, T_shape_world * T_world_b * of_b.T_link_shape) < padding)
        return true;
    }
  }
  return false;
}

void find_solids_that_always_touch(const RobotModel& robot, std::uint64_t seed,
                                   std::vector<LinkPairSurvey>& pairs) {
  constexpr int kStates = 50;
  Rng rng(seed, "solids");
  for (LinkPairSurvey& pair : pairs) pair.solids_always_touch = !pair.disabled;
  std::vector<Pose> T_world_link;
  for (int i = 0; i < kStates; ++i) {
    const TrolleyState trolley = draw_trolley(robot, rng);
    robot.link_poses(draw_configuration(robot, rng), trolley, T_world_link);
    for (LinkPairSurvey& pair : pairs) {
      if (!pair.solids_always_touch) continue;
      const auto a = static_cast<std::size_t>(robot.link_index(pair.link_a));
      const auto b = static_cast<std::size_t>(robot.link_index(pair.link_b));
      pair.solids_always_touch =
          solids_touch(robot.links()[a], T_world_link[a], robot.links()[b], T_world_link[b]);
    }
  }
}

}  // namespace

std::vector<LinkPairSurvey> survey_link_pairs(const RobotModel& robot, int states,
                                              std::uint64_t seed) {
  const ExactChecker exact(robot);
  Rng rng(seed, "link pairs");
  std::map<std::pair<int, int>, int> touching;
  for (int i = 0; i < states; ++i) {
    const TrolleyState trolley = draw_trolley(robot, rng);
    for (const auto& pair : exact.touching_pairs(draw_configuration(robot, rng), trolley))
      ++touching[pair];
  }
  std::vector<LinkPairSurvey> pairs;
  const int links = static_cast<int>(robot.links().size());
  for (int a = 0; a < links; ++a) {
    for (int b = a + 1; b < links; ++b) {
      if (robot.links()[a].collision.empty() || robot.links()[b].collision.empty() ||
          robot.rigidly_joined(a, b))
        continue;
      LinkPairSurvey pair;
      pair.link_a = robot.links()[a].name;
      pair.link_b = robot.links()[b].name;
      pair.adjacent = robot.joined_by_a_joint(a, b);
      pair.disabled = !robot.pair_checked(a, b);
      pair.states = states;
      const auto it = touching.find({a, b});
      pair.touching = it == touching.end() ? 0 : it->second;
      pairs.push_back(std::move(pair));
    }
  }
  find_solids_that_always_touch(robot, seed, pairs);
  return pairs;
}

const char* LinkPairSurvey::reason_to_disable() const {
  if (adjacent) return "Adjacent";
  if (always()) return "Always";
  return never() ? "Never" : nullptr;
}

std::string srdf_of(const std::string& robot_name, const std::vector<LinkPairSurvey>& pairs) {
  std::string srdf =
      "<?xml version=\"1.0\"?>\n<!-- Pairs of links that need no check: joined by a joint, or "
      "always "
      "or never touching in " +
      std::to_string(pairs.empty() ? 0 : pairs.front().states) +
      " random states. -->\n<robot name=\"" + robot_name + "\">\n";
  for (const LinkPairSurvey& pair : pairs) {
    const char* const reason = pair.reason_to_disable();
    if (reason == nullptr) continue;
    srdf += "  <disable_collisions link1=\"" + pair.link_a + "\" link2=\"" + pair.link_b +
            "\" reason=\"" + reason + "\"/>\n";
  }
  return srdf + "</robot>\n";
}

ReachSurvey survey_reach(const RobotModel& robot, const ArmIk& ik, int side, int views,
                         std::uint64_t seed) {
  const Box& workspace = robot.workspace(side);
  const Box& region = robot.sampling_region(side);
  const CollisionChecker checker(robot, {});
  const std::string home_name = "side_" + std::to_string(side);
  const Configuration home = robot.has_home(home_name)
                                 ? robot.home(home_name)
                                 : Configuration((robot.span().lower + robot.span().upper) / 2.0);
  Rng rng(seed, "reach", static_cast<std::uint64_t>(side));
  ReachSurvey survey;
  std::vector<Configuration> found;
  // Boxes too far from each other give no views; then the survey stays empty.
  for (int draw = 0; draw < 1000 * views && survey.views < views; ++draw) {
    const Vec3 position = draw_point(workspace, rng);
    const Vec3 target = draw_point(region, rng);
    const double distance = (position - target).norm();
    if (distance < kNearest || distance > kFarthest) continue;
    ++survey.views;
    const std::size_t part = part_of(workspace, position);
    ++survey.part_views[part];
    ik.solve_view(position, target, home, found);
    if (found.empty()) continue;
    ++survey.reached;
    for (const Configuration& q : found) {
      if (!checker.state_free(q)) continue;
      ++survey.free;
      ++survey.part_free[part];
      break;
    }
  }
  return survey;
}

Box arm_bounds(const RobotModel& robot, const Configuration& q) {
  std::vector<Pose> T_world_link;
  robot.link_poses(q, {}, T_world_link);
  const Pose T_base_world = robot.T_world_base({}).inverse();
  Box bounds;
  for (const int index : robot.moving_links()) {
    for (const CollisionShape& shape : robot.links()[index].collision) {
      const Vec3 half = shape.half_extents();
      bounds.extend(
          transformed(Box(-half, half), T_base_world * T_world_link[index] * shape.T_link_shape));
    }
  }
  return bounds;
}

std::vector<CoverSurvey> survey_covers(const RobotModel& robot, double sphere_excess_m) {
  std::vector<CoverSurvey> covers;
  for (const int index : robot.moving_links()) {
    const Link& link = robot.links()[index];
    if (link.collision.empty()) continue;
    std::vector<Sphere> spheres;
    for (const CollisionShape& shape : link.collision) {
      const auto cover = cover_with_spheres(shape, sphere_excess_m);
      spheres.insert(spheres.end(), cover.begin(), cover.end());
    }
    // Each sample is held against all of them.
    constexpr std::size_t kFew = 64;
    const std::size_t many = std::max(kFew, spheres.size() + link.collision.size());
    const int samples = static_cast<int>(200000 * kFew / many);
    covers.push_back({link.name, static_cast<int>(spheres.size()),
                      measure_cover(link.collision, spheres, samples)});
  }
  return covers;
}

}  // namespace canopeer
