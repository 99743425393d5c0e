#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/ros2/out/missing_frames.h"
#include "canopeer/ros2/time/ros_clock.h"

namespace canopeer::ros {

/// Tells the robot's description and frames where nobody else does, in a thread of its own. It
/// listens first, and falls silent when somebody else begins to.
class FrameTeller {
 public:
  struct Parts {
    Node& node;
    const RosClock& clock;
    const RobotModel& robot;
    /// Where the robot is now; nothing when nobody knows. Thread-safe.
    std::function<std::optional<RobotPlace>()> where;
    std::string description{};  ///< URDF; empty: none is told
    std::chrono::milliseconds listen_first{2000};
  };
  /// All parts outlive it. The error: a topic cannot be had.
  [[nodiscard]] static Expected<std::unique_ptr<FrameTeller>> make(
      Parts parts, const Ros2OutputSettings& settings);

 private:
  FrameTeller(Parts parts, const Ros2OutputSettings& settings)
      : parts_(std::move(parts)), settings_(settings) {}
  [[nodiscard]] Expected<void> open();
  void run(const std::stop_token& stop);
  void tell_frames();
  void tell_description();

  Parts parts_;
  Ros2OutputSettings settings_;
  OthersFrames others_;
  Publisher<tf2_msgs::TFMessage> tf_;
  std::optional<Publisher<std_msgs::String>> description_;  // of the thread
  std::jthread thread_;                                     // first to go
};

}  // namespace canopeer::ros
