#pragma once

#include <vector>

#include "canopeer/mission/mission_options.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// When a mission's segments can begin at the earliest and have to be over, whoever plans: what
/// mission/mission.cpp and segment_runner.cpp do, with nothing slower than it must be. A segment
/// begins with a frame at home; no motion to a view begins after its deadline, but one under way
/// then is finished and its frame counts.
struct SegmentTimes {
  double look_s = 0.0;  ///< that a frame at a view costs at least before the arm moves on
  bool stays = true;    ///< segments last until their time is up: no planner leaves earlier
  bool whole = false;   ///< deadlines are mission time; else each segment's own
  int max_views = 0;    ///< a segment at most; 0: no limit
  /// T: nothing counts after it; infinite with the paper's clock.
  double end_s = 0.0;
  std::vector<double> earliest_s;  ///< start of each segment, mission time
  /// Infinite: none. With the whole clock mission time, else after the segment's start.
  std::vector<double> deadline_s;
  std::vector<double> leave_s;  ///< what the way to the next segment's home takes of the arm
  std::vector<double> drive_s;  ///< of the trolley to the next stop; the last has none

  [[nodiscard]] std::size_t count() const { return earliest_s.size(); }
  [[nodiscard]] bool has_deadline(std::size_t segment) const;
  /// When the trolley can leave it at the earliest, mission time.
  [[nodiscard]] double earliest_leave_s(std::size_t segment) const;
  /// T; with the paper's clock when the last segment's time is up at the earliest, infinite where
  /// it has no limit.
  [[nodiscard]] double horizon_s() const;
};

/// `leave_s`: by segment, what the arm needs at least from anywhere it has looked to the next home;
/// 0 where nothing is known.
[[nodiscard]] SegmentTimes segment_times(const RobotModel& robot, const MissionOptions& mission,
                                         std::vector<double> leave_s);

[[nodiscard]] Configuration segment_home(const RobotModel& robot, const SegmentPlan& segment);

}  // namespace canopeer
