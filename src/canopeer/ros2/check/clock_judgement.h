#pragma once

#include <optional>

#include "canopeer/ros2/check/findings.h"

namespace canopeer::ros {

/// Which clocks stamps are of. `joints_s`, `camera_s`: least ages of their messages
/// (ClockDifference). `time_offset_s`: what settings add to the camera's stamps.
void judge_clocks(std::optional<double> joints_s, std::optional<double> camera_s,
                  double time_offset_s, Findings& findings);

/// Whether the time is the one everybody goes by. `clock_published`: somebody publishes /clock.
void judge_sim_time(bool use_sim_time, bool clock_published, bool running, Findings& findings);

}  // namespace canopeer::ros
