#include "canopeer/bounds/tours/pool_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

double drive_s(const Joint& axis, double distance_m) {
  if (distance_m == 0.0) return 0.0;
  return axis_motion_time(distance_m, axis.velocity_limit, axis.acceleration_limit);
}

}  // namespace

PoolMotions::PoolMotions(const ViewPool& pool, const TourViews& views, const RobotModel& robot,
                         const MotionJudge& judge, const MissionOptions& mission,
                         double way_home_factor, MotionVerdicts& verdicts)
    : pool_(pool),
      views_(views),
      robot_(robot),
      judge_(judge),
      mission_(mission),
      way_home_factor_(way_home_factor),
      verdicts_(verdicts) {
  for (const auto& segment : views.segments) {
    edges_.emplace_back(segment.size() * segment.size());
    home_s_.emplace_back(segment.size(), -1.0);
  }
}

std::size_t PoolMotions::in_pool(int segment, int view) const {
  return views_.pool_index[static_cast<std::size_t>(segment)][static_cast<std::size_t>(view)];
}

const Configuration& PoolMotions::q(int segment, int view) const {
  return pool_.segments[static_cast<std::size_t>(segment)][in_pool(segment, view)].q;
}

PoolMotions::Edge& PoolMotions::edge(int segment, int from, int to) {
  const auto s = static_cast<std::size_t>(segment);
  Edge& found = edges_[s][static_cast<std::size_t>(from) * views_.segments[s].size() +
                          static_cast<std::size_t>(to)];
  if (found.time_s < 0.0F) {
    const Configuration& a = q(segment, from);
    const Configuration b = robot_.endless().nearest(q(segment, to), a);
    found.time_s =
        static_cast<float>(straight_motion_time(a, b, robot_, mission_.on_the_way.limit()));
  }
  return found;
}

double PoolMotions::time_s(int segment, int from, int to) { return edge(segment, from, to).time_s; }

bool PoolMotions::judge(int segment, int from, int to) {
  const auto s = static_cast<std::size_t>(segment);
  if (const auto known = verdicts_.known(s, in_pool(segment, from), in_pool(segment, to))) {
    return *known;
  }
  const Configuration& a = q(segment, from);
  const Configuration b = robot_.endless().nearest(q(segment, to), a);
  const bool free = judge_.free({a, b}, mission_.segments[s].trolley);
  verdicts_.keep(s, in_pool(segment, from), in_pool(segment, to), free);
  return free;
}

bool PoolMotions::free(int segment, int from, int to) {
  Edge& wanted = edge(segment, from, to);
  if (!wanted.judged) {
    wanted.judged = true;
    ++judged_;
    if (!judge(segment, from, to)) {
      ++blocked_;
      wanted.time_s = std::numeric_limits<float>::infinity();
    }
  }
  return std::isfinite(wanted.time_s);
}

double PoolMotions::transition_s(int segment, int from) {
  const auto s = static_cast<std::size_t>(segment);
  double& known = home_s_[s][static_cast<std::size_t>(from)];
  if (known >= 0.0) return known;
  const std::size_t next = std::min(s + 1, mission_.segments.size() - 1);
  const SegmentPlan& here = mission_.segments[s];
  const SegmentPlan& there = mission_.segments[next];
  const Configuration& a = q(segment, from);
  const Configuration home =
      robot_.endless().nearest(robot_.home("side_" + std::to_string(there.side)), a);
  known = way_home_factor_ * motion_time(a, home, robot_.limits()) +
          drive_s(robot_.travel_axis(), std::abs(there.trolley.travel_m - here.trolley.travel_m)) +
          drive_s(robot_.lift_axis(), std::abs(there.trolley.lift_m - here.trolley.lift_m));
  return known;
}

}  // namespace canopeer
