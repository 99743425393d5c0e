#pragma once

#include <vector>

#include "canopeer/mission/mission_options.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// T of a mission whose clock never stops (MissionClock::whole): what its segments are given, and
/// the fastest transitions that robot and trolley are capable of, s. It depends on the mission and
/// the robot only, so it is the same for every planner.
///
/// A transition takes the arm from home state to home state, straight, as if nothing stood in its
/// way, and then the trolley, one axis after the other. The way back from a segment's last view is
/// not in it: a planner that goes far from home pays for it.
[[nodiscard]] double whole_mission_time_s(const RobotModel& robot, const MissionOptions& mission);

/// When each segment has to be over, mission time, s: the last one at mission.mission_time_s.
/// Shares are those of the segments' budgets and transitions, so segments that were put together
/// for a planner (row_segments.h) end with the same T.
[[nodiscard]] std::vector<double> segment_deadlines_s(const RobotModel& robot,
                                                      const MissionOptions& mission);

/// What segment `index` gets when it begins at `t_s` and the row has one budget
/// (MissionOptions::shares_time): its share of what is left behind the fastest transitions to come,
/// s; of the last segment all of it. Not above 0: nothing is left.
[[nodiscard]] double shared_time_s(const RobotModel& robot, const MissionOptions& mission,
                                   int index, double t_s);

}  // namespace canopeer
