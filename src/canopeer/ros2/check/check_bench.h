#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/config/mission_file.h"
#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/arm/ros2_arm.h"
#include "canopeer/ros2/camera/ros2_camera.h"
#include "canopeer/ros2/check/joint_ear.h"
#include "canopeer/ros2/check/node_ear.h"
#include "canopeer/ros2/check/topic_judgement.h"
#include "canopeer/ros2/trolley/ros2_trolley.h"

namespace canopeer::ros {

/// Everything of a robot that a mission would use, listened to. Nothing moves by itself.
struct CheckBench {
  /// `file` and `robot` outlive it. The error: settings are wrong, or there is no network.
  [[nodiscard]] static Expected<std::unique_ptr<CheckBench>> open(const MissionFile& file,
                                                                  const RobotModel& robot,
                                                                  std::function<bool()> stop_asked);

  /// Messages are counted from now on.
  void count_from_now();
  /// The camera's topics, and what came on each.
  [[nodiscard]] std::vector<ListenedTopic> camera_topics() const;
  /// How old images are when they come in; nothing: none came.
  [[nodiscard]] std::optional<double> image_age_s() const;
  /// Of the images; empty: none, or none came.
  [[nodiscard]] std::string frame_id() const;

  CheckBench(const MissionFile& file, const RobotModel& robot);

  const MissionFile& file;
  const RobotModel& robot;
  const Ros2Settings settings;
  std::unique_ptr<Node> node;
  std::unique_ptr<RosClock> clock;
  JointHistory joints;  ///< of minutes
  TrolleySense sense;
  TfBuffer tf;
  std::unique_ptr<JointListener> listener;
  std::unique_ptr<JointEar> joint_ear;
  NodeEar node_ear;
  std::unique_ptr<Ros2Arm> arm;
  std::unique_ptr<Ros2Trolley> trolley;
  std::unique_ptr<Ros2Camera> camera;
  std::vector<std::int64_t> counted_before;  ///< of camera_topics()
  int infos = 0;                             ///< camera infos that came, under `mutex`
  mutable std::mutex mutex;
  std::vector<Subscription> subscriptions;  ///< last: they stop first
};

}  // namespace canopeer::ros
