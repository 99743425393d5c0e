#pragma once

#include <functional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/mission_file.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// One thing that was looked at.
struct Ros2Finding {
  enum class Verdict { ok, notice, wrong };
  Verdict verdict = Verdict::ok;
  std::string what;  ///< "joint states"
  std::string text;  ///< what was found, and what to change; one line
};

/// How long is listened, whether the arm may move, and who is told.
struct Ros2CheckOptions {
  double listen_s = 3.0;  ///< how long rates are measured
  bool move = false;      ///< moves the arm a little, to check mounting and clock of the camera
  int looks = 12;         ///< small motions at most, for that
  std::function<void(const Ros2Finding&)> on_finding;  ///< as they are made
  std::function<bool()> stop_asked;                    ///< a motion under way ends; may be empty
};

/// Listens to the robot of a mission and says what is there, what fits, and what to change; nothing
/// moves unless asked for. `robot` has the limits that motions keep. All findings in their order;
/// the robot can be used when none is wrong. The error: settings are wrong, or there is no network.
[[nodiscard]] Expected<std::vector<Ros2Finding>> check_ros2_robot(const MissionFile& file,
                                                                  const RobotModel& robot,
                                                                  const Ros2CheckOptions& options);

}  // namespace canopeer
