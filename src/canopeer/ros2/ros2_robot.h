#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/mission_file.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// How the simulated robot behaves. Topics, names and network are those of the mission's site
/// (Ros2Settings).
struct Ros2RobotOptions {
  std::string node = "simulated_robot";
  double joint_rate_hz = 125.0;     ///< of control and joint states
  bool split_joint_states = false;  ///< arm and trolley are said by two publishers
  double camera_rate_hz = 6.0;
  double camera_latency_s = 0.03;
  std::string color_encoding = "rgb8";   ///< or bgr8, rgba8, bgra8, mono8
  std::string depth_encoding = "16UC1";  ///< or 32FC1
  bool sim_time = false;                 ///< stamps and /clock of its own
  double sim_rate = 1.0;                 ///< how fast that clock runs
  std::vector<std::string> faults;       ///< on from the beginning: RobotFaults::set()

  [[nodiscard]] Expected<void> validate() const;
};

/// What happened to a simulated robot.
struct Ros2RobotReport {
  int goals = 0;               ///< of the arm
  int refused = 0;             ///< of these
  int arrived = 0;             ///< of these
  int cut_short = 0;           ///< aborted, cancelled, preempted
  int motions = 0;             ///< of the arm, from standstill to standstill
  int collisions = 0;          ///< motions with: the robot itself or the structure
  int plant_contacts = 0;      ///< motions with
  int frames = 0;              ///< sent
  double longest_gap_s = 0.0;  ///< between two joint states
};

/// The simulated glasshouse of a mission as a robot on ROS 2: arm and trolley behind controllers,
/// joint states, tf, a camera. On the wall clock, in threads of its own, until it is destroyed.
class Ros2Robot {
 public:
  /// The arm starts at the first segment's home. `robot` outlives what is started. The error:
  /// options, faults, or the network.
  [[nodiscard]] static Expected<std::unique_ptr<Ros2Robot>> start(const MissionFile& file,
                                                                  const RobotModel& robot,
                                                                  Scene scene,
                                                                  const Ros2RobotOptions& options);
  ~Ros2Robot();

  /// Switches a fault on or off, "slow:0.3", "slow:off", "none"; also topic `~/fault`
  /// (std_msgs/String).
  [[nodiscard]] Expected<void> set_fault(std::string_view fault);
  /// Waits until all motions so far are judged.
  [[nodiscard]] Ros2RobotReport report();

 private:
  struct State;
  explicit Ros2Robot(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The faults there are, a line each: "slow:SCALE (0.3)  a pendant …".
[[nodiscard]] std::vector<std::string> ros2_robot_faults();

}  // namespace canopeer
