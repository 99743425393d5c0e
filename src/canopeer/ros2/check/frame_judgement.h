#pragma once

#include <string>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/camera/camera_feed.h"
#include "canopeer/ros2/camera/tf_buffer.h"
#include "canopeer/ros2/check/findings.h"

namespace canopeer::ros {

/// What a frame shows, against the camera that the mission plans with.
void judge_frame(const Expected<TimedFrame>& frame, const CameraIntrinsics& planned,
                 Findings& findings);

/// Where tf has the camera, against the robot's description at `q`. `frame_id`: of the images.
void judge_tf(const TfBuffer& tf, const RobotModel& robot, const Configuration& q,
              const Ros2CameraSettings& settings, const std::string& frame_id, Findings& findings);

}  // namespace canopeer::ros
