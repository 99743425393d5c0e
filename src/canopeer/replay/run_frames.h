#pragma once

#include <memory>
#include <string>
#include <vector>

#include "canopeer/mission/event.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/replay/frame.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// What a run is, for its first frames.
struct RunStory {
  std::string mission;
  std::string planner;
  std::uint64_t seed = 0;
  std::string canopeer_version;
  bool simulated = false;
  double segment_time_s = 0.0;
  double resolution_m = 0.01;
  std::vector<SegmentPlan> segments;
  CameraIntrinsics camera;
};

/// Turns the events of a run into frames (docs/live-view.md): every change once. It wants maps and
/// plans (EventNeeds). The same events, the same frames.
class RunFrames {
 public:
  /// The robot is copied. `truth` is looked at here only; null: nobody knows it.
  RunFrames(RunStory story, const RobotModel& robot, const Scene* truth);
  ~RunFrames();
  RunFrames(const RunFrames&) = delete;
  RunFrames& operator=(const RunFrames&) = delete;

  /// Hello, robot, truth.
  [[nodiscard]] std::vector<Frame> first() const;
  /// Any number of frames, mostly one.
  [[nodiscard]] std::vector<Frame> of(const Event& event);
  /// Events were lost: what comes says what they would have said, as far as it still matters.
  void missed();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
