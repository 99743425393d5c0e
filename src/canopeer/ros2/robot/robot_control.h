#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "canopeer/cdr/messages/ur_dashboard_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/ros2/robot/joint_voice.h"
#include "canopeer/ros2/robot/motion_watch.h"
#include "canopeer/ros2/robot/trajectory_server.h"
#include "canopeer/ros2/robot/trolley_topics.h"

namespace canopeer::ros {

/// Moves arm and trolley at a steady rate and says what they do, in a thread of its own.
class RobotControl {
 public:
  struct Parts {  ///< all outlive the control
    Node& node;
    const RobotModel& robot;
    const RobotClock& clock;
    RobotFaults& faults;
    RobotHistory& history;
    MotionWatch& watch;
  };
  [[nodiscard]] static Expected<std::unique_ptr<RobotControl>> start(const Parts& parts,
                                                                     const Ros2Settings& names,
                                                                     const SimulatedPlace& place,
                                                                     double rate_hz, bool split);
  [[nodiscard]] TrajectoryServer::Counts arm_counts() const { return arm_.counts(); }
  void release() { arm_.release(); }
  /// The longest that nothing was said of the joints, though no fault wants it so.
  [[nodiscard]] double longest_gap_s() const { return longest_gap_s_; }

 private:
  RobotControl(const Parts& parts, const Ros2Settings& names, const SimulatedPlace& place);
  [[nodiscard]] Expected<void> join(const Ros2Settings& names, bool split);
  void work(double rate_hz, const std::stop_token& stop);
  void say_safety_mode();
  void tick(Stamp now, double dt_s, std::int64_t number);

  Parts parts_;
  TrolleyAxes axes_;
  std::unique_ptr<JointVoice> voice_;
  TrajectoryServer arm_;
  std::unique_ptr<TrajectoryServer> trolley_;
  std::unique_ptr<TrolleyTopics> trolley_topics_;
  Publisher<std_msgs::Float64> speed_scaling_;
  Publisher<ur_dashboard_msgs::SafetyMode> safety_mode_;
  std::uint8_t said_mode_ = 0;
  std::atomic<double> longest_gap_s_{0.0};
  std::jthread worker_;
};

}  // namespace canopeer::ros
