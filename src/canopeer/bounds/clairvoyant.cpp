#include "canopeer/bounds/clairvoyant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "canopeer/bounds/tours/pool_motions.h"
#include "canopeer/bounds/tours/tour_search.h"
#include "canopeer/mission/mission_time.h"

namespace canopeer {
namespace {

Expected<void> check_pool(const ViewPool& pool, const RobotModel& robot,
                          const MissionOptions& mission) {
  if (pool.segments.size() != mission.segments.size()) {
    return fail("the pool of views has " + std::to_string(pool.segments.size()) +
                " segments, and the mission has " + std::to_string(mission.segments.size()));
  }
  if (pool.patches.fruit.size() != pool.patches.area_cm2.size()) {
    return fail("the pool of views has not as many areas as patches");
  }
  for (std::size_t s = 0; s < pool.segments.size(); ++s) {
    const std::string where = "segment " + std::to_string(s + 1) + " of the pool of views: ";
    if (pool.segments[s].empty()) return fail(where + "it lacks the view at home");
    for (const PoolView& view : pool.segments[s]) {
      if (view.q.size() != robot.dof()) {
        return fail(where + "a view has " + std::to_string(view.q.size()) +
                    " joint positions, and the robot has " + std::to_string(robot.dof()) +
                    " joints");
      }
      for (const std::uint32_t patch : view.patches) {
        if (patch >= pool.patches.fruit.size()) {
          return fail(where + "a view shows patch " + std::to_string(patch) + " of " +
                      std::to_string(pool.patches.fruit.size()));
        }
      }
    }
  }
  return {};
}

TourClock clock_of(const RobotModel& robot, const MissionOptions& mission,
                   const ClairvoyantOptions& options) {
  TourClock clock;
  for (const SegmentPlan& segment : mission.segments) {
    const double limit_s = segment.time_s > 0.0 ? segment.time_s : mission.segment_time_s;
    clock.budget_s.push_back(limit_s > 0.0 ? limit_s : std::numeric_limits<double>::infinity());
    clock.max_views.push_back(segment.max_views > 0 ? segment.max_views : mission.max_views);
  }
  if (mission.mission_time_s > 0.0) {
    clock.deadline_s = segment_deadlines_s(robot, mission);
    if (mission.shares_time) {
      clock.shared_s = [&robot, &mission](int segment, double t_s) {
        return shared_time_s(robot, mission, segment, t_s);
      };
    }
  }
  clock.observe_s = options.latency_s + view_cost_s(options.view_work, mission.costs);
  clock.leave_when_done = mission.leave_when_done;
  return clock;
}

/// Time that finds are early in: the mission's, or that of a tour which found what it could.
double horizon_s(const TourProblem& problem, const RobotModel& robot,
                 const MissionOptions& mission) {
  if (mission.mission_time_s > 0.0) return mission.mission_time_s;
  const bool timed = std::all_of(problem.clock.budget_s.begin(), problem.clock.budget_s.end(),
                                 [](double limit_s) { return std::isfinite(limit_s); });
  if (timed) return whole_mission_time_s(robot, mission);
  return std::max(1.0, outcome_of(problem, greedy_tour(problem)).end_s);
}

void wish_for(TourProblem& problem, const RobotModel& robot, const MissionOptions& mission,
              ClairvoyantOptions::Objective objective) {
  constexpr double kTies = 0.02;
  problem.horizon_s = horizon_s(problem, robot, mission);
  const bool auc = objective == ClairvoyantOptions::Objective::auc;
  problem.ever = auc ? kTies : 1.0;
  problem.early = auc ? 1.0 : kTies;
}

/// By fruit, those of `ids`. Of a fruit that shows little no more is wanted than most of that.
std::vector<double> wanted_areas_cm2(const ViewPool& pool, const std::vector<int>& ids,
                                     const FindRule& rule, const std::vector<double>& factors) {
  constexpr double kMostOfIt = 0.9;
  std::map<int, double> seen_cm2;
  std::vector<bool> seen(pool.patches.fruit.size(), false);
  for (const std::vector<PoolView>& segment : pool.segments) {
    for (const PoolView& view : segment) {
      for (const std::uint32_t patch : view.patches) {
        if (!seen[patch]) seen_cm2[pool.patches.fruit[patch]] += pool.patches.area_cm2[patch];
        seen[patch] = true;
      }
    }
  }
  std::vector<double> wanted;
  for (const int id : ids) {
    const auto index = static_cast<std::size_t>(id);
    const double factor = index < factors.size() ? factors[index] : 1.0;
    const double more = std::min(factor * rule.min_area_cm2, kMostOfIt * seen_cm2[id]);
    wanted.push_back(std::max(rule.min_area_cm2, more));
  }
  return wanted;
}

}  // namespace

double view_cost_s(const ViewWork& work, const CostTable& costs) {
  WorkMeter meter;
  meter.add(Work::detect_frame);
  meter.add(Work::fruit_frame);
  meter.add(Work::fuse_point, work.fuse_points);
  meter.add(Work::field_block, work.field_blocks);
  meter.add(Work::target_block, work.target_blocks);
  return meter.seconds(costs);
}

Expected<ClairvoyantPlan> plan_clairvoyant(const ViewPool& pool, const RobotModel& robot,
                                           const MotionJudge& judge, const MissionOptions& mission,
                                           const FindRule& rule, const ClairvoyantOptions& options,
                                           MotionVerdicts* verdicts) {
  if (auto ok = check_pool(pool, robot, mission); !ok) return tl::unexpected(ok.error());
  TourViewOptions thinning;
  thinning.per_segment = options.views_per_segment;
  const TourViews views = tour_views(pool, robot, rule.min_area_cm2, thinning);
  MotionVerdicts own;
  PoolMotions motions(pool, views, robot, judge, mission, options.way_home_factor,
                      verdicts != nullptr ? *verdicts : own);

  TourProblem problem;
  problem.segments = views.segments;
  problem.patch_cm2 = pool.patches.area_cm2;
  problem.fruits = static_cast<int>(views.fruit_ids.size());
  problem.fruits_total = std::max(pool.patches.fruits_total, problem.fruits);
  problem.min_area_cm2 = wanted_areas_cm2(pool, views.fruit_ids, rule, options.area_factors);
  problem.clock = clock_of(robot, mission, options);
  problem.motions = &motions;
  wish_for(problem, robot, mission, options.objective);

  TourSearchOptions search;
  search.beam.width = options.beam_width;
  search.beam.slices = options.beam_slices;
  search.beam.most_views = options.most_views;
  search.local.max_trials = options.max_trials;
  search.rounds = options.rounds;
  const Tour tour = best_tour(problem, search);
  TourOutcome outcome = outcome_of(problem, tour);

  ClairvoyantPlan result;
  for (std::size_t s = 0; s < tour.size(); ++s) {
    auto& configurations = result.plan.segments.emplace_back();
    auto& indices = result.views.emplace_back();
    for (const int view : tour[s]) {
      indices.push_back(views.pool_index[s][static_cast<std::size_t>(view)]);
      configurations.push_back(pool.segments[s][indices.back()].q);
    }
  }
  result.times_s = std::move(outcome.times_s);
  result.fruits = outcome.found;
  for (std::size_t f = 0; f < outcome.found_s.size(); ++f) {
    if (std::isfinite(outcome.found_s[f])) result.fruit_ids.push_back(views.fruit_ids[f]);
  }
  result.auc = outcome.auc;
  result.end_s = outcome.end_s;
  result.motions_judged = motions.judged();
  result.motions_blocked = motions.blocked();
  return result;
}

std::optional<std::size_t> shorten(ViewPlan& plan, std::size_t segment) {
  for (std::size_t n = std::min(segment + 1, plan.segments.size()); n > 0; --n) {
    auto& views = plan.segments[n - 1];
    if (views.empty()) continue;
    views.resize(views.size() / 2);
    return n - 1;
  }
  return std::nullopt;
}

}  // namespace canopeer
