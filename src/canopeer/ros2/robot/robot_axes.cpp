#include "canopeer/ros2/robot/robot_axes.h"

namespace canopeer::ros {

TrolleyAxes::TrolleyAxes(const RobotModel& robot)
    : travels_(!robot.setup().travel_joint.empty()), lifts_(!robot.setup().lift_joint.empty()) {
  std::vector<const Joint*> axes;
  if (travels_) axes.push_back(&robot.travel_axis());
  if (lifts_) axes.push_back(&robot.lift_axis());
  lower_.resize(static_cast<Eigen::Index>(axes.size()));
  upper_.resize(lower_.size());
  if (travels_) joints_.push_back(robot.setup().travel_joint);
  if (lifts_) joints_.push_back(robot.setup().lift_joint);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    lower_[static_cast<Eigen::Index>(i)] = axes[i]->lower;
    upper_[static_cast<Eigen::Index>(i)] = axes[i]->upper;
  }
}

Configuration TrolleyAxes::positions(const TrolleyState& state) const {
  Configuration q(lower_.size());
  if (travels_) q[0] = state.travel_m;
  if (lifts_) q[q.size() - 1] = state.lift_m;
  return q;
}

TrolleyState TrolleyAxes::state(const Configuration& positions) const {
  TrolleyState state;
  if (travels_) state.travel_m = positions[0];
  if (lifts_) state.lift_m = positions[positions.size() - 1];
  return state;
}

}  // namespace canopeer::ros
