#include "canopeer/mission/mission_time.h"

#include <cmath>
#include <string>

#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

double fastest_drive_s(const Joint& axis, double distance) {
  if (distance == 0.0) return 0.0;
  return axis_motion_time(distance, axis.velocity_limit, axis.acceleration_limit);
}

Configuration home_of_segment(const RobotModel& robot, const SegmentPlan& segment) {
  return robot.home("side_" + std::to_string(segment.side));
}

double fastest_transition_s(const RobotModel& robot, const SegmentPlan& from,
                            const SegmentPlan& to) {
  const Configuration begin = home_of_segment(robot, from);
  const Configuration end = robot.endless().nearest(home_of_segment(robot, to), begin);
  const TrolleyState& last = from.row.empty() ? from.trolley : from.row.back();
  return motion_time(begin, end, robot.limits()) +
         fastest_drive_s(robot.travel_axis(), std::abs(to.trolley.travel_m - last.travel_m)) +
         fastest_drive_s(robot.lift_axis(), std::abs(to.trolley.lift_m - last.lift_m));
}

double own_time_s(const SegmentPlan& segment, const MissionOptions& mission) {
  return segment.time_s > 0.0 ? segment.time_s : mission.segment_time_s;
}

/// When each segment is over when all transitions are as fast as can be.
std::vector<double> earliest_ends_s(const RobotModel& robot, const MissionOptions& mission) {
  std::vector<double> ends;
  double t_s = 0.0;
  for (std::size_t i = 0; i < mission.segments.size(); ++i) {
    const SegmentPlan& segment = mission.segments[i];
    if (i > 0) t_s += fastest_transition_s(robot, mission.segments[i - 1], segment);
    t_s += own_time_s(segment, mission);
    ends.push_back(t_s);
  }
  return ends;
}

}  // namespace

double whole_mission_time_s(const RobotModel& robot, const MissionOptions& mission) {
  const std::vector<double> ends = earliest_ends_s(robot, mission);
  return ends.empty() ? 0.0 : ends.back();
}

std::vector<double> segment_deadlines_s(const RobotModel& robot, const MissionOptions& mission) {
  std::vector<double> deadlines = earliest_ends_s(robot, mission);
  if (deadlines.empty()) return deadlines;
  const double scale = mission.mission_time_s / deadlines.back();
  for (double& t_s : deadlines) t_s *= scale;
  deadlines.back() = mission.mission_time_s;
  return deadlines;
}

double shared_time_s(const RobotModel& robot, const MissionOptions& mission, int index,
                     double t_s) {
  const auto first = static_cast<std::size_t>(index);
  double left_s = mission.mission_time_s - t_s;
  double own_s = 0.0;
  for (std::size_t i = first; i < mission.segments.size(); ++i) {
    const SegmentPlan& segment = mission.segments[i];
    if (i > first) left_s -= fastest_transition_s(robot, mission.segments[i - 1], segment);
    own_s += own_time_s(segment, mission);
  }
  return left_s * own_time_s(mission.segments[first], mission) / own_s;
}

}  // namespace canopeer
