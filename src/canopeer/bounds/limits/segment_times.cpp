#include "canopeer/bounds/limits/segment_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/mission/mission_time.h"
#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

constexpr double kNoDeadline = std::numeric_limits<double>::infinity();

/// One axis after the other, as fast as can be.
double fastest_between(const RobotModel& robot, const TrolleyState& a, const TrolleyState& b) {
  const auto time_of = [](const Joint& axis, double distance) {
    return distance == 0.0
               ? 0.0
               : axis_motion_time(distance, axis.velocity_limit, axis.acceleration_limit);
  };
  return time_of(robot.travel_axis(), b.travel_m - a.travel_m) +
         time_of(robot.lift_axis(), b.lift_m - a.lift_m);
}

}  // namespace

Configuration segment_home(const RobotModel& robot, const SegmentPlan& segment) {
  return robot.home("side_" + std::to_string(segment.side));
}

bool SegmentTimes::has_deadline(std::size_t segment) const {
  return std::isfinite(deadline_s[segment]);
}

double SegmentTimes::earliest_leave_s(std::size_t segment) const {
  double time_s = earliest_s[segment] + look_s + leave_s[segment];
  if (stays && has_deadline(segment)) {
    time_s = std::max(time_s, deadline_s[segment] + (whole ? 0.0 : earliest_s[segment]));
  }
  return time_s;
}

double SegmentTimes::horizon_s() const {
  if (std::isfinite(end_s)) return end_s;
  return earliest_s.back() + deadline_s.back();
}

SegmentTimes segment_times(const RobotModel& robot, const MissionOptions& mission,
                           std::vector<double> leave_s) {
  const std::size_t count = mission.segments.size();
  CANOPEER_CHECK(leave_s.size() == count, "one figure a segment");
  SegmentTimes times;
  times.look_s = mission.costs[Work::detect_frame] + mission.costs[Work::fruit_frame];
  times.whole = mission.mission_time_s > 0.0;
  times.stays = !mission.leave_when_done && mission.max_views == 0 && !mission.shares_time;
  times.max_views = mission.max_views;
  times.end_s = times.whole ? mission.mission_time_s : kNoDeadline;
  times.leave_s = std::move(leave_s);
  if (times.whole) {
    times.deadline_s = segment_deadlines_s(robot, mission);
    if (mission.shares_time) {
      std::fill(times.deadline_s.begin(), times.deadline_s.end(), mission.mission_time_s);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const SegmentPlan& segment = mission.segments[i];
    if (!times.whole) {
      const double own_s = segment.time_s > 0.0 ? segment.time_s : mission.segment_time_s;
      times.deadline_s.push_back(own_s > 0.0 ? own_s : kNoDeadline);
      times.stays = times.stays && own_s > 0.0;  // without a limit it ends when nothing comes of it
    }
    // Who drives along the row itself is not spoken of; its segments cost nothing to reach.
    const bool drives = i + 1 < count && segment.row.empty();
    times.drive_s.push_back(
        drives ? fastest_between(robot, segment.trolley, mission.segments[i + 1].trolley) : 0.0);
    times.earliest_s.push_back(i == 0 ? 0.0 : times.earliest_leave_s(i - 1) + times.drive_s[i - 1]);
  }
  return times;
}

}  // namespace canopeer
