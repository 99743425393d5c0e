#include "canopeer/mission/segment/traveller.h"

#include <algorithm>

#include "canopeer/base/rng.h"

namespace canopeer {

Traveller::Traveller(const RobotModel& robot, const MotionPlannerOptions& options,
                     std::uint64_t seed)
    : planner_(robot, options), endless_(robot.endless()), seed_(seed) {}

std::vector<Configuration> Traveller::way_home(const Configuration& q, const Configuration& home,
                                               const CollisionChecker& checker, WorkMeter& work) {
  constexpr double kThere = 1e-9;
  std::vector<Configuration> back = {q};
  if (endless_.distance(q, home) < kThere) return back;
  for (auto step = state_.way.rbegin();; ++step) {
    MotionPlanStats stats;
    const auto plan = planner_.plan(back.back(), home, checker,
                                    Rng(seed_, "way home", state_.plans++).bits(), &stats);
    work.add(Work::motion_plan, stats.states_checked);
    if (plan) {
      back.insert(back.end(), plan->begin() + 1, plan->end());
      return back;
    }
    if (step == state_.way.rend()) return back;
    // An arm may count its turns anew, so the way is not one line of real numbers.
    const Configuration before = endless_.nearest(*step, back.back());
    if (joint_distance(before, back.back()) > kThere) back.push_back(before);
  }
}

void Traveller::took(const std::vector<Configuration>& waypoints) {
  state_.way.insert(state_.way.end(), waypoints.begin(), waypoints.end());
}

void Traveller::forget_way(const Configuration& q) { state_.way = {q}; }

}  // namespace canopeer
