#pragma once

#include <map>
#include <string>
#include <string_view>

#include "canopeer/mission/event.h"
#include "canopeer/replay/frame.h"
#include "canopeer/robot/robot_model.h"

// What happens, one frame each.

namespace canopeer::frames {

[[nodiscard]] Frame segment_frame(const SegmentEvent& segment, const TrolleyState& trolley);
[[nodiscard]] Frame trolley_frame(const MotionEvent& drive, const TrolleyState& there);
/// `camera`: when it is another than the one told last, else null.
[[nodiscard]] Frame view_frame(const ViewEvent& view, const TrolleyState& trolley,
                               const CameraIntrinsics* camera);
/// A frame on the way: from where it was taken, and what came of it.
[[nodiscard]] Frame look_frame(const FrameEvent& frame);
/// The path as it is timed, stretched to the duration that is expected.
[[nodiscard]] Frame motion_frame(const MotionBegun& motion, const RobotModel& robot);
[[nodiscard]] Frame motion_end_frame(const MotionEvent& motion);
[[nodiscard]] Frame work_frame(const std::vector<WorkItem>& work);
/// `word`: said by who steers; empty: nobody did.
[[nodiscard]] Frame log_frame(double t_s, std::string_view level, const std::string& text,
                              std::string_view word = {});
[[nodiscard]] Frame end_frame(const RunEnded& end);

/// Fruits that changed since the last time.
class FruitFrames {
 public:
  [[nodiscard]] Frame fruits(const FruitsFound& found);

 private:
  std::map<int, std::string> told_;
};

}  // namespace canopeer::frames
