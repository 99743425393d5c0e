#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/dds/node.h"
#include "canopeer/mission/ports.h"
#include "canopeer/ros2/camera/camera_feed.h"

namespace canopeer::ros {

/// What a camera needs to know besides its own topics. All outlive it.
struct CameraSurroundings {
  const RobotModel& robot;
  const JointHistory& joints;  ///< of all arm joints, by the names of the robot's description
  TrolleyAt trolley;
  std::function<Stamp()> now;                   ///< ROS time
  std::function<double(Stamp)> mission_time_s;  ///< of a stamp by the clock of joint states
  double min_range_m = 0.15;                    ///< nearer and farther surfaces give no return
  double max_range_m = 3.0;
  double tf_span_s = 10.0;                  ///< how far back tf is remembered
  std::function<Expected<void>()> alive{};  ///< see CameraFeed::Parts
  /// Up to when it is known where the trolley was; empty, or nothing: nobody says it.
  std::function<std::optional<Stamp>()> trolley_known_until{};
};

/// The camera on ROS 2 topics, as a mission sees it. Thread-safe.
class Ros2Camera : public Camera {
 public:
  /// Subscribes; topics need not be there yet. The error names the setting that is wrong.
  [[nodiscard]] static Expected<std::unique_ptr<Ros2Camera>> make(
      Node& node, const Ros2CameraSettings& settings, const CameraSurroundings& around);
  ~Ros2Camera() override;

  /// A frame from after the arm stood still. See CameraFeed::capture().
  [[nodiscard]] Expected<RgbdFrame> capture() override;
  [[nodiscard]] Expected<void> stream(double hz) override;
  /// Their twist is that of the last 20 ms, by the same poses.
  [[nodiscard]] Expected<std::vector<StreamedFrame>> arrived() override;
  /// Frames from while it moves, too, not_before(), and what was counted.
  [[nodiscard]] CameraFeed& feed() { return *feed_; }
  /// Topics that a frame needs, with their types: what must be there.
  struct Topic {
    std::string name;  ///< as in the settings
    std::string type;  ///< "sensor_msgs/msg/Image"
  };
  [[nodiscard]] static std::vector<Topic> topics(const Ros2CameraSettings& settings);
  /// From tf; empty where poses come from joint states.
  [[nodiscard]] const TfBuffer& tf() const { return tf_; }
  /// How long frames took from arrival to use and to decode, in capture(), s: the first 1000.
  struct Latencies {
    std::vector<double> waited_s, decoded_s;
  };
  [[nodiscard]] Latencies latencies() const;

 private:
  explicit Ros2Camera(const CameraSurroundings& around) : tf_(around.tf_span_s), around_(around) {}
  [[nodiscard]] std::optional<StreamedFrame> streamed(const CameraFeed::Messages& messages);
  [[nodiscard]] bool trolley_lags(Stamp stamp) const;
  [[nodiscard]] Expected<void> subscribe(Node& node, const Ros2CameraSettings& settings);
  [[nodiscard]] Expected<void> subscribe_part(Node& node, FramePart part, const std::string& topic,
                                              const Qos& qos);
  template <class Message>
  [[nodiscard]] Expected<void> subscribe_as(Node& node, FramePart part, const std::string& topic,
                                            const Qos& qos);

  TfBuffer tf_;
  const CameraSurroundings around_;
  std::unique_ptr<CameraFeed> feed_;
  mutable std::mutex mutex_;  // of what follows
  Latencies latencies_;
  std::optional<CameraIntrinsics> intrinsics_;  // of the last frame
  double hz_ = 0.0;                             // of the stream
  Stamp streamed_ = 0;  // the last one that was looked at, or when the stream began
  Stamp due_ = 0;       // when the next one is to come
  std::vector<Subscription> subscriptions_;  // last: they stop first
};

}  // namespace canopeer::ros
