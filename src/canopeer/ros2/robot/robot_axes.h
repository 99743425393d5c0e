#pragma once

#include <map>
#include <string>
#include <vector>

#include "canopeer/robot/robot_model.h"

namespace canopeer::ros {

/// A joint of the URDF as the robot's driver calls it.
[[nodiscard]] inline std::string driver_name(const std::map<std::string, std::string>& names,
                                             const std::string& joint) {
  const auto found = names.find(joint);
  return found == names.end() ? joint : found->second;
}

/// The axes of a trolley that there are, travel before lift, as joints of a controller.
class TrolleyAxes {
 public:
  explicit TrolleyAxes(const RobotModel& robot);
  [[nodiscard]] bool none() const { return joints_.empty(); }
  /// Names of the URDF.
  [[nodiscard]] const std::vector<std::string>& joints() const { return joints_; }
  [[nodiscard]] const Configuration& lower() const { return lower_; }
  [[nodiscard]] const Configuration& upper() const { return upper_; }
  [[nodiscard]] Configuration positions(const TrolleyState& state) const;
  [[nodiscard]] TrolleyState state(const Configuration& positions) const;

 private:
  bool travels_;
  bool lifts_;
  std::vector<std::string> joints_;
  Configuration lower_;
  Configuration upper_;
};

}  // namespace canopeer::ros
