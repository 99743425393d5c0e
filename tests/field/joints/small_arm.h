#pragma once

#include <gtest/gtest.h>

#include <string>

#include "canopeer/robot/robot_model.h"

namespace canopeer::test {

/// An arm of six joints (a waist, two elbows, a roll, a bend, a roll) as the text of its files, to
/// be changed piece by piece. Line 1 of the URDF is <robot>; each joint and link has a line of its
/// own.
struct SmallArm {
  std::string urdf;
  std::string yaml;

  SmallArm();
  /// Replaces the first occurrence in either file; it must be there.
  SmallArm& replace(const std::string& from, const std::string& to);
  /// Adds lines before the end of the URDF, and to the robot file.
  SmallArm& add(const std::string& urdf_lines, const std::string& yaml_lines = "");

  [[nodiscard]] Expected<RobotModel> load() const;
  /// The robot; a failure of the test when it is refused.
  [[nodiscard]] RobotModel model() const;
  /// Why it is refused, without the folder's name; "accepted" when it is not.
  [[nodiscard]] std::string error() const;
  /// What is said of it, each on a line, without the folder's name.
  [[nodiscard]] std::string notices() const;
};

/// A joint of the URDF in one line; `more` goes inside.
std::string joint_line(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& xyz, const std::string& axis,
                       const std::string& more = "");

/// Pose of a link in the world with the trolley at its beginning.
Pose pose_of(const RobotModel& robot, const std::string& link, const Configuration& q);

}  // namespace canopeer::test
