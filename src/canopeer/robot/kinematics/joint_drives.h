#pragma once

#include <string>
#include <vector>

#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// What moves a joint of a description.
struct JointDrive {
  enum class Kind { kStands, kArm, kTravel, kLift };
  Kind kind = Kind::kStands;
  int arm_joint = -1;            ///< in RobotSetup::arm_joints; only of kArm
  bool follows = false;          ///< it mimics what moves so
  double multiplier = 1.0;       ///< its position is multiplier · (the other's) + offset
  double offset = 0.0;           ///< of one that stands: its position
  Pose pose = Pose::Identity();  ///< of a planar or floating joint
};

struct JointDrives {
  std::vector<JointDrive> of;  ///< parallel to the description's joints
  std::vector<std::string> problems;
  std::vector<std::string> notices;
};

/// Finds for each joint what moves it: itself as an arm joint or axis of the trolley, the joint it
/// mimics (through any number of joints), or nothing. What stands does so where the setup says;
/// else at 0, or at the limit next to it, which is a notice. Problems: a joint to mimic that does
/// not exist, circles, an arm joint that mimics, positions of joints that do not stand.
[[nodiscard]] JointDrives find_drives(const RobotDescription& robot, const RobotSetup& setup);

/// Checks the limits of the joints that move by themselves, and narrows them to what the joints
/// that follow them allow. What is wrong or odd is added to `drives`.
void limit_drivers(RobotDescription& robot, JointDrives& drives);

/// "file:line: joint 'name'".
[[nodiscard]] std::string joint_title(const Joint& joint);

/// T_parent_child of a joint at a position.
[[nodiscard]] Pose joint_pose(const Joint& joint, double position);

}  // namespace canopeer
