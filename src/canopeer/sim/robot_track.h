#pragma once

#include <memory>

#include "canopeer/robot/joint_path.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/straight_timing.h"
#include "canopeer/sensing/camera_twist.h"

namespace canopeer {

/// Where arm, trolley and camera are at any time of the motion under way; before it begins and
/// after it ends, where it does. Arm and trolley do not move at the same time. A copy is cheap.
class RobotTrack {
 public:
  /// All stand. `robot` outlives the track.
  RobotTrack(const RobotModel& robot, const Configuration& q, const TrolleyState& trolley);

  void stand(const Configuration& q, const TrolleyState& trolley);
  /// The arm sets out along `path` at that time.
  void move_arm(const JointPath& path, double start_s);
  /// The trolley does: one axis after the other, as the linear drives of such trolleys do; along
  /// the row no faster than `max_travel_m_s` (0: as fast as it can).
  double drive(const TrolleyState& goal, double max_travel_m_s, double start_s);

  [[nodiscard]] Configuration arm_at(double t_s) const;
  [[nodiscard]] TrolleyState trolley_at(double t_s) const;
  [[nodiscard]] Pose camera_at(double t_s) const;  ///< T_world_camera
  [[nodiscard]] CameraTwist twist_at(double t_s) const;

 private:
  const RobotModel* robot_;
  Configuration q_;  ///< before the motion
  TrolleyState trolley_;
  double start_s_ = 0.0;
  std::shared_ptr<const PathMotion> arm_;
  std::shared_ptr<const StraightMotion> travel_, lift_;
};

}  // namespace canopeer
