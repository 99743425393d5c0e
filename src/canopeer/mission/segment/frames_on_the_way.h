#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "canopeer/mission/events/event_hub.h"
#include "canopeer/mission/mission_cursor.h"
#include "canopeer/mission/perception.h"
#include "canopeer/mission/ports.h"
#include "canopeer/mission/segment/timekeeper.h"
#include "canopeer/robot/self_filter.h"

namespace canopeer {

/// Perception beside the motion: frames that come while the arm or the trolley moves wait in a
/// short queue, one after the other is taken in, and what several of them changed is told to the
/// planner at once. So it plans with one consistent map, between two changes.
///
/// In simulated time a frame costs what the compute table says, of a core of its own: whoever comes
/// while too many wait is late. On the wall clock a thread does the same with the time it really
/// takes.
class FramesOnTheWay {
 public:
  /// All outlive it; `cursor` says where the mission is, and is told how far away things are.
  FramesOnTheWay(const RobotModel& robot, const Ports& ports, const MissionOptions& options,
                 Perception& perception, Timekeeper& time, EventHub& events, MissionCursor& cursor);
  ~FramesOnTheWay();
  FramesOnTheWay(const FramesOnTheWay&) = delete;
  FramesOnTheWay& operator=(const FramesOnTheWay&) = delete;

  /// The mission wants frames at all.
  [[nodiscard]] bool wanted() const { return options_.on_the_way.hz > 0.0; }

  /// Where targets are wanted after frames, world; what the planner reads of the map in other
  /// threads is made by `snapshot`. Empty: nobody plans at present.
  struct Planning {
    Box region_world;
    std::function<std::shared_ptr<const MapSnapshot>()> snapshot;
  };
  void plan_with(Planning planning) { planning_ = std::move(planning); }

  /// A motion of this kind ("view", "home", "trolley") begins. The error is the camera's.
  [[nodiscard]] Expected<void> set_out(const std::string& during);
  /// It takes so long: in simulated time that passes here, frame by frame; the planner's background
  /// work goes on in it.
  [[nodiscard]] Expected<void> go_along(double duration_s);
  /// It is over: what still waits is taken in, and told. Nothing: no frames were wanted.
  [[nodiscard]] Expected<std::optional<FrameCounts>> arrive();
  /// In place of arrive(), after an exception: nobody works on frames any more.
  void abandon();

 private:
  /// A frame that counts, and how blurred it was judged to be.
  struct Waiting {
    StreamedFrame frame;
    double blur_px = 0.0;
  };
  void stop_thread();
  [[nodiscard]] bool counts() const;
  [[nodiscard]] double end_s() const { return options_.mission_time_s + cursor_.held_s; }
  [[nodiscard]] Expected<void> fetch();
  void admit(StreamedFrame frame);
  [[nodiscard]] Expected<void> work_off(double until_s);
  [[nodiscard]] Expected<void> take_in(const Waiting& next);
  [[nodiscard]] double blur_px(const StreamedFrame& frame) const;
  [[nodiscard]] bool alike(const StreamedFrame& frame) const;
  [[nodiscard]] Expected<void> tell();
  void work_until_told(const std::stop_token& stop);

  const RobotModel& robot_;
  Ports ports_;
  const MissionOptions& options_;
  Perception& perception_;
  Timekeeper& time_;
  EventHub& events_;
  MissionCursor& cursor_;
  SelfFilter self_filter_;
  Planning planning_;
  // Of the motion under way:
  std::string during_;
  bool open_ = false;
  std::deque<Waiting> waiting_;
  std::atomic<double> arrived_s_{0.0};  ///< when the motion ended; infinity: it has not
  double free_s_ = 0.0;                 ///< when what was begun is done, by the compute table
  Pose T_last_ = Pose::Identity();      ///< of the camera, when a frame was taken in last
  int untold_ = 0;                      ///< frames the planner has not heard of
  FrameCounts counts_;
  StageTimer stages_;
  Expected<void> failure_;  ///< of the thread
  std::jthread thread_;     // last: it ends first
};

}  // namespace canopeer
