#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/camera/tf_buffer.h"
#include "canopeer/ros2/time/joint_history.h"

namespace canopeer::ros {

/// Where the trolley stood then.
using TrolleyAt = std::function<TrolleyState(Stamp)>;

/// Where the camera was. Thread-safe. Times are by the clock of joint states, or of tf.
class FramePoses {
 public:
  virtual ~FramePoses() = default;
  /// T_world_camera. The error: not known then; whether to wait for it says known_until().
  [[nodiscard]] virtual Expected<Pose> at(Stamp stamp, const std::string& frame_id) const = 0;
  /// The newest time of which the pose is known. Nothing: none.
  [[nodiscard]] virtual std::optional<Stamp> known_until(const std::string& frame_id) const = 0;
};

/// By joint states, between the two next to the time: T_world_base(trolley) · T_base_camera(q). The
/// history holds the robot's arm joints under the names of its description. All outlive it.
[[nodiscard]] std::unique_ptr<FramePoses> poses_of_joints(const RobotModel& robot,
                                                          const JointHistory& joints,
                                                          TrolleyAt trolley);

/// By tf: T_world_base(trolley) · T(`base_frame`, optical frame). `optical_frame` empty: the one in
/// the images' headers.
[[nodiscard]] std::unique_ptr<FramePoses> poses_of_tf(const RobotModel& robot, const TfBuffer& tf,
                                                      std::string base_frame,
                                                      std::string optical_frame, TrolleyAt trolley);

/// Arm joints of a row of positions in the order of the history's joints. The history has them all.
[[nodiscard]] Configuration arm_configuration(const RobotModel& robot, const JointHistory& joints,
                                              const std::vector<double>& positions);

}  // namespace canopeer::ros
