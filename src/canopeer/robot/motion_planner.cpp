#include "canopeer/robot/motion_planner.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"
#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Space = ob::RealVectorStateSpace;

Configuration configuration_of(const ob::State* state, int dof) {
  return Eigen::Map<const Configuration>(state->as<Space::StateType>()->values, dof);
}

/// Draws from our own stream: OMPL's generators are seeded by a global count of their making.
class SeededSampler : public ob::RealVectorStateSampler {
 public:
  SeededSampler(const ob::StateSpace* space, std::uint64_t seed)
      : RealVectorStateSampler(space), random_(seed, "motion-planner") {}

  void sampleUniform(ob::State* state) override {
    const ob::RealVectorBounds& bounds = static_cast<const Space*>(space_)->getBounds();
    double* values = state->as<Space::StateType>()->values;
    for (std::size_t i = 0; i < bounds.low.size(); ++i)
      values[i] = random_.uniform(bounds.low[i], bounds.high[i]);
  }
  void sampleUniformNear(ob::State*, const ob::State*, double) override {
    CANOPEER_CHECK(false, "RRTConnect draws uniform samples only");
  }
  void sampleGaussian(ob::State*, const ob::State*, double) override {
    CANOPEER_CHECK(false, "RRTConnect draws uniform samples only");
  }

 private:
  Rng random_;
};

class EdgeValidator : public ob::MotionValidator {
 public:
  EdgeValidator(const ob::SpaceInformationPtr& information, const CollisionChecker& checker,
                int dof, int& states_checked)
      : MotionValidator(information),
        checker_(checker),
        dof_(dof),
        states_checked_(states_checked) {}

  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return checker_.edge_free(configuration_of(a, dof_), configuration_of(b, dof_),
                              &states_checked_);
  }
  bool checkMotion(const ob::State*, const ob::State*,
                   std::pair<ob::State*, double>&) const override {
    CANOPEER_CHECK(false, "RRTConnect asks for whole motions only");
    return false;
  }

 private:
  const CollisionChecker& checker_;
  int dof_;
  int& states_checked_;
};

using Path = std::vector<Configuration>;

std::optional<Path> rrt_connect(const Configuration& start, const Configuration& goal,
                                const JointLimits& limits, const CollisionChecker& checker,
                                const MotionPlannerOptions& options, std::uint64_t seed,
                                MotionPlanStats& stats) {
  const int dof = static_cast<int>(start.size());
  ompl::msg::noOutputHandler();  // the library prints nothing

  auto space = std::make_shared<Space>(dof);
  ob::RealVectorBounds bounds(static_cast<unsigned>(dof));
  for (int i = 0; i < dof; ++i) {
    bounds.setLow(
        static_cast<unsigned>(i),
        std::max(limits.lower[i], std::min(start[i], goal[i]) - options.sampling_margin_rad));
    bounds.setHigh(
        static_cast<unsigned>(i),
        std::min(limits.upper[i], std::max(start[i], goal[i]) + options.sampling_margin_rad));
  }
  space->setBounds(bounds);
  space->setStateSamplerAllocator(
      [seed](const ob::StateSpace* s) { return std::make_shared<SeededSampler>(s, seed); });

  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([&checker, dof, &stats](const ob::State* state) {
    ++stats.states_checked;
    return checker.state_free(configuration_of(state, dof));
  });
  information->setMotionValidator(
      std::make_shared<EdgeValidator>(information, checker, dof, stats.states_checked));
  information->setup();

  auto problem = std::make_shared<ob::ProblemDefinition>(information);
  ob::ScopedState<Space> from(space);
  ob::ScopedState<Space> to(space);
  for (int i = 0; i < dof; ++i) {
    from->values[i] = start[i];
    to->values[i] = goal[i];
  }
  problem->setStartAndGoalStates(from, to);

  og::RRTConnect planner(information);
  planner.setRange(options.range_rad);
  // The default structure picks pivots with a generator of its own, seeded behind our back.
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  planner.setProblemDefinition(problem);
  planner.setup();
  const ob::PlannerTerminationCondition enough(
      [&stats, &options] { return ++stats.iterations > options.max_iterations; });
  if (planner.solve(enough) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;

  Path path;
  for (const ob::State* state : problem->getSolutionPath()->as<og::PathGeometric>()->getStates())
    path.push_back(configuration_of(state, dof));
  return path;
}

/// Time from one place of a path (segment, fraction) to a later one, stopping at each waypoint.
struct Place {
  std::size_t segment = 0;
  double fraction = 0.0;

  [[nodiscard]] Configuration on(const Path& path) const {
    return path[segment] + fraction * (path[segment + 1] - path[segment]);
  }
};

double path_time(const Path& path, const JointLimits& limits) {
  double time = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) time += motion_time(path[i - 1], path[i], limits);
  return time;
}

/// Replaces stretches between two random places by straight motions where that saves time.
void shortcut(Path& path, const JointLimits& limits, const CollisionChecker& checker, int attempts,
              Rng& random, MotionPlanStats& stats) {
  for (int attempt = 0; attempt < attempts && path.size() > 2; ++attempt) {
    // Half of the tries join waypoints: they are what removes stops.
    const bool waypoints = attempt % 2 == 0;
    const auto draw = [&]() -> Place {
      if (!waypoints) {
        const std::size_t segment = random.index(path.size() - 1);
        return {segment, random.uniform()};
      }
      const std::size_t waypoint = random.index(path.size());
      return waypoint + 1 == path.size() ? Place{waypoint - 1, 1.0} : Place{waypoint, 0.0};
    };
    Place first = draw();
    Place second = draw();
    if (std::pair(second.segment, second.fraction) < std::pair(first.segment, first.fraction))
      std::swap(first, second);
    if (first.segment == second.segment) continue;

    Path shorter(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(first.segment) + 1);
    const Configuration a = first.on(path);
    const Configuration b = second.on(path);
    if (first.fraction > 0.0) shorter.push_back(a);
    if (second.fraction < 1.0) shorter.push_back(b);
    shorter.insert(shorter.end(), path.begin() + static_cast<std::ptrdiff_t>(second.segment) + 1,
                   path.end());
    if (path_time(shorter, limits) >= path_time(path, limits)) continue;
    if (checker.edge_free(a, b, &stats.states_checked)) path = std::move(shorter);
  }
}

/// A free state that can be reached from `start` without coming nearer to anything.
std::optional<Configuration> escape(const Configuration& start, const CollisionChecker& checker,
                                    int attempts, std::uint64_t seed, MotionPlanStats& stats) {
  constexpr double kFarthestRad = 0.5;  // per joint; near states are tried first
  Rng random(seed, "motion-planner-escape");
  for (int attempt = 1; attempt <= attempts; ++attempt) {
    const double radius = kFarthestRad * attempt / attempts;
    Configuration q = start;
    for (double& joint : q) joint += random.uniform(-radius, radius);
    if (checker.escape_free(start, q, &stats.states_checked)) return q;
  }
  return std::nullopt;
}

}  // namespace

MotionPlanner::MotionPlanner(const RobotModel& robot, const MotionPlannerOptions& options)
    : robot_(&robot), options_(options) {}

std::optional<std::vector<Configuration>> MotionPlanner::plan(const Configuration& start,
                                                              const Configuration& goal,
                                                              const CollisionChecker& checker,
                                                              std::uint64_t seed,
                                                              MotionPlanStats* stats) const {
  MotionPlanStats unused;
  MotionPlanStats& work = stats == nullptr ? unused : *stats;
  work.states_checked += 2;
  if (!checker.state_free(goal)) return std::nullopt;
  if (!checker.state_free(start)) {
    const auto nearby = escape(start, checker, options_.escape_attempts, seed, work);
    if (!nearby) return std::nullopt;
    auto rest = plan(*nearby, goal, checker, seed, &work);
    if (rest) rest->insert(rest->begin(), start);
    return rest;
  }
  if (checker.edge_free(start, goal, &work.states_checked)) return Path{start, goal};

  auto path = rrt_connect(start, goal, robot_->limits(), checker, options_, seed, work);
  if (!path) return std::nullopt;
  Rng random(seed, "motion-planner-shortcut");
  shortcut(*path, robot_->limits(), checker, options_.shortcut_attempts, random, work);
  return path;
}

}  // namespace canopeer
