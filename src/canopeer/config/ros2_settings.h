#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// How the arm is moved and heard.
struct Ros2ArmSettings {
  std::string action = "/joint_trajectory_controller/follow_joint_trajectory";
  std::vector<std::string> joint_states = {"/joint_states"};
  /// Names of the robot's joints as the driver says them, where they differ: URDF name to driver's.
  std::map<std::string, std::string> joint_names;
  double rate_hz = 100.0;             ///< points of a trajectory, a second
  double speed_scale = 0.5;           ///< of the limits of velocity; (0, 1]
  int first_motions = 3;              ///< so many are slower still:
  double first_motion_scale = 0.25;   ///< of `speed_scale`; (0, 1]
  double start_tolerance_rad = 0.02;  ///< between where a motion begins and where the arm is
  double path_tolerance_rad = 0.1;    ///< 0: the controller's own
  double goal_tolerance_rad = 0.01;   ///< 0: the controller's own
  double goal_time_tolerance_s = 5.0;
  double max_silence_s = 0.5;  ///< of joint states; of feedback while moving twice as long
  /// How often as long as planned a motion may take before it is cancelled: a pendant may slow it.
  double max_slowdown = 20.0;
  /// ur_dashboard_msgs/SafetyMode, as the UR driver says it: a protective or emergency stop ends a
  /// motion at once, and none begins in one. Empty: such stops are told by what the controller
  /// says.
  std::string safety_mode;
};

/// Where frames come from.
struct Ros2CameraSettings {
  std::string color = "/camera/color/image_raw";  ///< ".../compressed": JPEG or PNG
  std::string depth = "/camera/aligned_depth_to_color/image_raw";  ///< ".../compressedDepth": PNG
  std::string info = "/camera/color/camera_info";
  std::string points;              ///< an organised cloud in place of the three above
  std::string labels;              ///< mono8 or 8UC1, values of PixelLabel; empty: none
  std::string confidences;         ///< 32FC1 0 … 1 or mono8 0 … 255 with `labels`; empty: none
  double min_confidence = 0.5;     ///< labels below it are background
  bool reliable = false;           ///< ask for every image; else those that come through
  double max_difference_s = 0.02;  ///< between stamps of what belongs together
  std::string pose = "joint_states";      ///< or "tf"
  std::string optical_frame;              ///< for tf; empty: that of the images' headers
  std::string world_frame = "base_link";  ///< for tf: of the robot's base link
  double time_offset_s = 0.0;  ///< added to stamps of images gives the clock of joint states
  double settle_s = 0.1;       ///< after the arm stood still
  double timeout_s = 3.0;      ///< without a frame that is new enough
};

/// How the trolley is moved.
struct Ros2TrolleySettings {
  enum class Kind { fixed, trajectory, topics, manual };
  Kind kind = Kind::manual;  ///< fixed: it never moves
  /// Where it stands at first, travel and lift, m, where nothing says it; empty: at the first stop.
  std::vector<double> start_m;
  std::string action;          ///< trajectory: FollowJointTrajectory of the axes
  std::string travel_command;  ///< topics: std_msgs/Float64, m
  std::string travel_state;    ///< topics: std_msgs/Float64, m; empty: joint states
  std::string lift_command;
  std::string lift_state;
  double speed_m_s = 0.2;      ///< trajectory: the fastest; others: what is expected
  double tolerance_m = 0.005;  ///< where it counts as arrived
  double timeout_s = 120.0;
  /// manual: how far beside the stop the person may leave it; the map says where it stands.
  double manual_tolerance_m = 0.15;
};

/// What is told to others.
struct Ros2OutputSettings {
  bool enabled = true;
  bool robot_description = true;  ///< where nobody else does
  bool tf = true;                 ///< where nobody else does
  std::string map_frame = "map";  ///< what the mission's world is called
  double map_rate_hz = 1.0;       ///< at most so many maps a second
  double image_rate_hz = 2.0;
};

/// A robot spoken to by ROS 2; keys in docs/formats.md.
struct Ros2Settings {
  std::string node = "canopeer";
  std::string ns = "/";
  std::optional<int> domain;            ///< 0 … 232; none: what the program's caller says, or 0
  std::vector<std::string> interfaces;  ///< IPv4 addresses; empty: loopback; "any"
  std::vector<std::string> peers;       ///< IPv4 addresses asked besides multicast
  std::map<std::string, std::string> remaps;
  bool shared_memory = false;
  bool use_sim_time = false;
  double discovery_s = 10.0;  ///< how long everything that is needed is waited for
  Ros2ArmSettings arm;
  Ros2CameraSettings camera;
  Ros2TrolleySettings trolley;
  Ros2OutputSettings output;
  bool dry_run = false;         ///< plans and publishes, never moves
  bool confirm = false;         ///< every motion is asked for
  bool wait_for_start = false;  ///< nothing is done until `~/start` is called

  /// The error names the key.
  [[nodiscard]] Expected<void> validate() const;
};

}  // namespace canopeer
