#pragma once

#include <string>
#include <vector>

#include "canopeer/robot/robot_model.h"

namespace canopeer::ros {

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
