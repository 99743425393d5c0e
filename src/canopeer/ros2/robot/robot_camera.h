#pragma once

#include <deque>
#include <memory>
#include <string>
#include <thread>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/ros2/robot/robot_clock.h"
#include "canopeer/ros2/robot/robot_history.h"
#include "canopeer/ros2/robot/robot_images.h"

namespace canopeer::ros {

/// How a simulated camera takes and sends frames.
struct RobotCameraOptions {
  double rate_hz = 6.0;
  double latency_s = 0.03;  ///< from exposure to sending, at least
  std::string color_encoding = "rgb8";
  std::string depth_encoding = "16UC1";
};

/// The camera as its driver shows it. Frames are rendered where the camera was when they were
/// taken, also while it moves, and only when somebody listens.
class RobotCamera {
 public:
  /// Topics are those of `names`. What is referred to outlives the camera.
  [[nodiscard]] static Expected<std::unique_ptr<RobotCamera>> make(
      Node& node, const Ros2CameraSettings& names, const RobotCameraOptions& options,
      const RobotModel& robot, const RgbdSensor& sensor, const RobotHistory& history,
      const RobotClock& clock, const RobotFaults& faults);
  ~RobotCamera();
  /// Sent so far.
  [[nodiscard]] int frames() const { return frames_; }

 private:
  struct Shot {
    Stamp due;  ///< when it is sent
    RgbdFrame frame;
    builtin_interfaces::Time stamp;
  };
  RobotCamera(const RobotCameraOptions& options, const RobotModel& robot, const RgbdSensor& sensor,
              const RobotHistory& history, const RobotClock& clock, const RobotFaults& faults);
  [[nodiscard]] Expected<void> advertise(Node& node, const Ros2CameraSettings& names);
  [[nodiscard]] bool watched() const;
  void work(const std::stop_token& stop);
  void wait_until(Stamp time, const std::stop_token& stop);
  [[nodiscard]] std::optional<Shot> take(Stamp exposure);
  void send(Shot& shot);
  void send_nonsense();

  RobotCameraOptions options_;
  const RobotModel& robot_;
  const RgbdSensor& sensor_;
  const RobotHistory& history_;
  const RobotClock& clock_;
  const RobotFaults& faults_;
  Publisher<sensor_msgs::Image> color_;
  Publisher<sensor_msgs::Image> depth_;
  Publisher<sensor_msgs::Image> labels_;
  Publisher<sensor_msgs::CameraInfo> info_;
  Publisher<sensor_msgs::PointCloud2> points_;
  std::shared_ptr<Writer> nonsense_;
  std::deque<Shot> to_send_;
  std::uint64_t taken_ = 0;
  std::atomic<int> frames_{0};
  std::jthread worker_;
};

}  // namespace canopeer::ros
