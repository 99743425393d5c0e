#pragma once

#include <string>
#include <vector>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/check/findings.h"
#include "canopeer/ros2/check/joint_ear.h"

namespace canopeer::ros {

/// Holds joint states against the robot's description: rate, age, names, positions. `trolley`:
/// joints of the description that the trolley is known by. `silent_why`: what is odd about a
/// topic's publishers; empty where nothing is. `listened_s`: how long they were heard.
void judge_joint_states(const RobotModel& robot, const Ros2ArmSettings& settings,
                        const std::vector<std::string>& trolley, const HeardJoints& heard,
                        double listened_s, const std::string& silent_why, Findings& findings);

/// Whether several publishers agree on joints of the arm and the trolley, while all stands still.
/// `nodes`: names of a publisher's participant.
void judge_speakers(const RobotModel& robot, const Ros2ArmSettings& settings,
                    const std::vector<std::string>& trolley, const HeardJoints& heard,
                    const std::map<ParticipantId, std::set<std::string>>& nodes,
                    Findings& findings);

}  // namespace canopeer::ros
