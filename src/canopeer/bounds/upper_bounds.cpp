#include "canopeer/bounds/upper_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "canopeer/base/check.h"
#include "canopeer/bounds/limits/bound_course.h"
#include "canopeer/bounds/limits/coverage_program.h"
#include "canopeer/bounds/limits/find_times.h"
#include "canopeer/bounds/limits/first_sight.h"
#include "canopeer/bounds/limits/marginals.h"

namespace canopeer {
namespace {

constexpr double kEver = std::numeric_limits<double>::infinity();
constexpr double kLate = 1e6;  // s: later than anything ends; programs want finite numbers

/// By segment, the least that the arm needs from any of its views to the next segment's home.
std::vector<double> ways_out_s(const ViewPool& pool, const RobotModel& robot,
                               const MissionOptions& mission, const MotionBound& motion) {
  std::vector<double> ways(pool.segments.size(), 0.0);
  for (std::size_t s = 0; s + 1 < ways.size(); ++s) {
    const Configuration home = segment_home(robot, mission.segments[s + 1]);
    ways[s] = kEver;
    for (const PoolView& view : pool.segments[s]) {
      ways[s] = std::min(ways[s], motion.between(view.q, home));
    }
  }
  return ways;
}

/// Whether each can be found by `t_s`.
std::vector<bool> open_by(const std::vector<double>& earliest_s, double t_s) {
  std::vector<bool> open;
  for (const double earliest : earliest_s) open.push_back(earliest <= t_s);
  return open;
}

/// The bounds of plans over a pool at some times, put on a course.
class SampledCourse {
 public:
  SampledCourse(const std::vector<SegmentColumns>& segments, const SegmentTimes& times,
                const std::vector<double>& earliest_s, bool on_the_way, const BoundOptions& options)
      : segments_(segments),
        times_(times),
        earliest_s_(earliest_s),
        options_(options),
        program_(segments, times, static_cast<int>(earliest_s.size()), on_the_way),
        marginals_(segments, static_cast<int>(earliest_s.size())),
        course_(earliest_s, "ceiling") {}

  [[nodiscard]] UpperBound result(int fruits_total, double end_s) {
    times_.stays ? segment_by_segment() : whenever_they_leave();
    return course_.result(fruits_total, end_s);
  }

 private:
  [[nodiscard]] double program_at(double t_s, std::size_t last) const {
    return program_.at(std::min(t_s, kLate), last, open_by(earliest_s_, t_s))
        .bound(options_.iterations);
  }

  void limit(double t_s, std::size_t last, double by_program) {
    std::vector<double> budgets;
    for (std::size_t s = 0; s <= last; ++s) {
      budgets.push_back(program_.budget_s(s, std::min(t_s, kLate)));
    }
    const double by_marginals = marginals_.bound(budgets, open_by(earliest_s_, t_s));
    if (by_marginals < by_program) {
      course_.limit(t_s, by_marginals, "marginals");
    } else {
      course_.limit(t_s, by_program, "linear program");
    }
  }

  /// Between the earliest starts of segment k and the next a plan is in k, or it is late and has
  /// all it can have before k.
  void segment_by_segment() {
    double late = 0.0;
    for (std::size_t k = 0; k < times_.count(); ++k) {
      const double from_s = times_.earliest_s[k];
      if (from_s >= times_.end_s) return;  // no plan gets there
      const bool ends = k + 1 == times_.count() || times_.earliest_s[k + 1] >= times_.end_s;
      const double to_s = ends ? times_.horizon_s() : times_.earliest_s[k + 1];
      for (int i = 1; i <= options_.times && std::isfinite(to_s); ++i) {
        const double t_s = from_s + (to_s - from_s) * i / options_.times;
        limit(t_s, k, std::max(late, program_at(t_s, k)));
      }
      if (!ends || !std::isfinite(times_.end_s)) {
        late = std::max(late, program_at(times_.whole ? times_.end_s : kEver, k));
      }
    }
    if (!std::isfinite(times_.end_s)) limit(kEver, times_.count() - 1, late);
  }

  /// By t a plan may be in any segment that can have begun.
  void whenever_they_leave() {
    double until_s = times_.horizon_s();
    if (!std::isfinite(until_s)) until_s = 2.0 * course_until_s();
    const int count = 3 * options_.times;
    for (int i = 1; i <= count; ++i) {
      const double t_s = until_s * i / count;
      const auto begun = static_cast<std::size_t>(
          std::upper_bound(times_.earliest_s.begin(), times_.earliest_s.end(), t_s) -
          times_.earliest_s.begin());
      double most = 0.0;
      for (std::size_t k = begun; k-- > 0;) {
        if (in_reach_by(k, t_s) > most) most = std::max(most, program_at(t_s, k));
      }
      limit(t_s, begun - 1, most);
    }
    if (!std::isfinite(times_.end_s)) {
      limit(kEver, times_.count() - 1, program_at(kEver, times_.count() - 1));
    }
  }

  [[nodiscard]] double course_until_s() const {
    double until_s = 1.0;
    for (const double t_s : earliest_s_) {
      if (std::isfinite(t_s)) until_s = std::max(until_s, t_s);
    }
    return until_s;
  }

  /// Fruits that segments up to `last` show, of those that can be found by then.
  [[nodiscard]] double in_reach_by(std::size_t last, double t_s) const {
    FruitSet shown(earliest_s_.size());
    for (std::size_t s = 0; s <= last; ++s) {
      shown.add(segments_[s].home.any);
      for (const VisitColumn& column : segments_[s].columns) {
        for (const auto& share : column.shares) shown.add(static_cast<std::size_t>(share.first));
      }
    }
    int count = 0;
    for (std::size_t f = 0; f < earliest_s_.size(); ++f) {
      count += shown.has(f) && earliest_s_[f] <= t_s;
    }
    return count;
  }

  const std::vector<SegmentColumns>& segments_;
  const SegmentTimes& times_;
  const std::vector<double>& earliest_s_;
  BoundOptions options_;
  CoverageProgram program_;
  Marginals marginals_;
  BoundCourse course_;
};

}  // namespace

UpperBound sampled_bound(const ViewPool& pool, const RobotModel& robot,
                         const MissionOptions& mission, const FindRule& rule,
                         const BoundOptions& options) {
  CANOPEER_CHECK(!pool.segments.empty() && pool.segments.size() == mission.segments.size(),
                 "the pool is of this mission");
  CANOPEER_CHECK(options.columns > 0 && options.times > 0, "counts are positive");
  const bool on_the_way = mission.on_the_way.hz > 0.0;
  const MotionBound motion(robot, on_the_way);
  const SegmentTimes times =
      segment_times(robot, mission, ways_out_s(pool, robot, mission, motion));
  const PoolFruits fruits = pool_fruits(pool.patches, rule);
  const std::vector<double> earliest_s = earliest_finds_s(pool, fruits, times, motion);
  std::vector<SegmentColumns> segments;
  for (const std::vector<PoolView>& views : pool.segments) {
    // Frames on the way are worked on beside the motion.
    segments.push_back(segment_columns(pool.patches, fruits, views, on_the_way ? 0.0 : times.look_s,
                                       motion, options.columns));
  }
  const double end_s = std::isfinite(times.end_s) ? times.end_s
                       : options.end_s > 0.0      ? options.end_s
                                                  : kEver;
  return SampledCourse(segments, times, earliest_s, on_the_way, options)
      .result(pool.patches.fruits_total, end_s);
}

UpperBound certified_bound(const Scene& scene, const RobotModel& robot,
                           const MissionOptions& mission, const CameraIntrinsics& camera,
                           const BoundOptions& options) {
  CANOPEER_CHECK(options.cells > 0, "counts are positive");
  const SegmentTimes times =
      segment_times(robot, mission, std::vector<double>(mission.segments.size(), 0.0));
  const double end_s = std::isfinite(times.end_s) ? times.end_s
                       : options.end_s > 0.0      ? options.end_s
                                                  : kEver;
  std::vector<double> earliest_s =
      first_sights_s(scene, robot, mission, camera, times, options.cells);
  std::erase_if(earliest_s, [&](double t_s) { return t_s > times.end_s; });
  return BoundCourse(std::move(earliest_s), "reach and frustum")
      .result(scene.counted_fruits(), end_s);
}

}  // namespace canopeer
