#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "canopeer/mission/segment/segment_course.h"
#include "canopeer/mission/steering.h"

namespace canopeer {

/// Where a mission is between two steps. Times are mission time, s.
struct MissionCursor {
  enum class Step : std::uint8_t {
    drive,    ///< the trolley to the segment's stop
    begin,    ///< the segment: first frame, at home
    decide,   ///< one decision of the planner and what it leads to
    go_home,  ///< the arm, to the next segment's home state
    done
  };
  Step next = Step::drive;
  std::int32_t segment = 0;  ///< 0 …
  std::int32_t views = 0;    ///< taken since the run began
  SegmentCourse course{};    ///< of the present segment
  double segment_start_s = 0.0;
  double standing_since_s = 0.0;
  double last_standing_s = 0.0;  ///< before the last motion
  double last_motion_s = 0.0;
  double held_s = 0.0;           ///< of the run, by steering
  double seen_distance_m = 0.0;  ///< median of what the last frame on the way showed; 0: none yet
  std::int32_t missed_motions = 0;  ///< in a row that did not arrive
  std::string needs_person;         ///< why the arm cannot go on by itself; told to steering once
  bool skip = false;                ///< told to end this segment
  bool stopped = false;             ///< told to end the run; who goes on from here ends it too
  SteeringWord::Kind said = SteeringWord::Kind::go_on;  ///< last

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(next, segment, views, course, segment_start_s, standing_since_s, last_standing_s,
            last_motion_s, held_s, seen_distance_m, missed_motions, needs_person, skip, stopped,
            said);
  }
};

[[nodiscard]] constexpr std::string_view step_name(MissionCursor::Step step) {
  constexpr std::string_view kNames[] = {"drive", "begin", "decide", "go_home", "done"};
  return kNames[static_cast<int>(step)];
}

}  // namespace canopeer
