#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/dds/node.h"
#include "canopeer/geometry/pose.h"

namespace canopeer::ros {

/// Which frames others tell on /tf and /tf_static, and in which ones. Thread-safe.
class OthersFrames {
 public:
  struct Frame {
    std::string parent;
    Pose T_parent_child = Pose::Identity();
  };
  /// By child. What was not said for ten seconds is forgotten, unless it is static.
  using Frames = std::map<std::string, Frame>;

  /// The node outlives it.
  [[nodiscard]] Expected<void> listen(Node& node);
  [[nodiscard]] Frames known() const;

 private:
  using Steady = std::chrono::steady_clock;
  struct Heard {
    Frame frame;
    Steady::time_point at;
    bool is_static = false;
  };
  void take(const tf2_msgs::TFMessage& message, bool is_static);

  mutable std::mutex mutex_;
  std::map<std::string, Heard> heard_;  // no more than kMostOthers
  Subscription moving_;
  Subscription static_;
};

}  // namespace canopeer::ros
