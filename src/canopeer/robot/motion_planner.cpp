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
using Values = ob::RealVectorStateSpace;

/// Joint space. Endless joints are real numbers in it, too; whatever joins two states goes the
/// shorter way round, so that the space is as far as it needs to know a cylinder or torus.
class Space : public Values {
 public:
  Space(unsigned dof, const EndlessJoints& endless) : Values(dof), endless_(endless) {}

  double distance(const ob::State* a, const ob::State* b) const override {
    if (!endless_.any()) return Values::distance(a, b);
    const int dof = static_cast<int>(getDimension());
    const Configuration from = values_of(a, dof);
    return (endless_.nearest(values_of(b, dof), from) - from).norm();
  }
  void interpolate(const ob::State* a, const ob::State* b, double t,
                   ob::State* state) const override {
    if (!endless_.any()) {
      Values::interpolate(a, b, t, state);
      return;
    }
    const int dof = static_cast<int>(getDimension());
    const Configuration from = values_of(a, dof);
    const Configuration to = endless_.nearest(values_of(b, dof), from);
    Eigen::Map<Configuration>(state->as<StateType>()->values, dof) = from + t * (to - from);
  }

 private:
  static Configuration values_of(const ob::State* state, int dof) {
    return Eigen::Map<const Configuration>(state->as<StateType>()->values, dof);
  }

  const EndlessJoints& endless_;
};

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
                const EndlessJoints& endless, int dof, int& states_checked)
      : MotionValidator(information),
        checker_(checker),
        endless_(endless),
        dof_(dof),
        states_checked_(states_checked) {}

  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    const Configuration from = configuration_of(a, dof_);
    return checker_.edge_free(from, endless_.nearest(configuration_of(b, dof_), from),
                              &states_checked_);
  }
  bool checkMotion(const ob::State*, const ob::State*,
                   std::pair<ob::State*, double>&) const override {
    CANOPEER_CHECK(false, "RRTConnect asks for whole motions only");
    return false;
  }

 private:
  const CollisionChecker& checker_;
  const EndlessJoints& endless_;
  int dof_;
  int& states_checked_;
};

using Path = std::vector<Configuration>;

std::optional<Path> rrt_connect(const Configuration& start, const Configuration& goal,
                                const RobotModel& robot, const CollisionChecker& checker,
                                const MotionPlannerOptions& options, std::uint64_t seed,
                                MotionPlanStats& stats) {
  const int dof = robot.dof();
  const JointLimits& limits = robot.limits();
  const EndlessJoints& endless = robot.endless();
  ompl::msg::noOutputHandler();  // the library prints nothing

  auto space = std::make_shared<Space>(static_cast<unsigned>(dof), endless);
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
      std::make_shared<EdgeValidator>(information, checker, endless, dof, stats.states_checked));
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
  for (const ob::State* state : problem->getSolutionPath()->as<og::PathGeometric>()->getStates()) {
    const Configuration q = configuration_of(state, dof);
    path.push_back(path.empty() ? q : endless.nearest(q, path.back()));
  }
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

/// Replaces stretches between two random places by straight motions where that saves time. The
/// shorter way round may end whole turns from where the stretch did; then so does what follows.
void shortcut(Path& path, const RobotModel& robot, const CollisionChecker& checker, int attempts,
              Rng& random, MotionPlanStats& stats) {
  const JointLimits& limits = robot.limits();
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
    Configuration b = second.on(path);
    if (first.fraction > 0.0) shorter.push_back(a);
    const std::size_t kept = shorter.size();
    if (second.fraction < 1.0) shorter.push_back(b);
    shorter.insert(shorter.end(), path.begin() + static_cast<std::ptrdiff_t>(second.segment) + 1,
                   path.end());
    if (robot.endless().any()) {
      const Configuration turns = robot.endless().nearest(b, a) - b;
      for (std::size_t i = kept; i < shorter.size(); ++i) shorter[i] += turns;
      b += turns;
    }
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
  const Configuration near = robot_->endless().nearest(goal, start);
  if (checker.edge_free(start, near, &work.states_checked)) return Path{start, near};

  auto path = rrt_connect(start, near, *robot_, checker, options_, seed, work);
  if (!path) return std::nullopt;
  Rng random(seed, "motion-planner-shortcut");
  shortcut(*path, *robot_, checker, options_.shortcut_attempts, random, work);
  return path;
}

}  // namespace canopeer
