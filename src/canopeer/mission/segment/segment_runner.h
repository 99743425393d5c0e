#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "canopeer/mission/robot_kit.h"
#include "canopeer/mission/segment/arm_mover.h"
#include "canopeer/mission/segment/frame_taker.h"

namespace canopeer {

/// What a segment works with, each with a job of its own. The cursor says where the mission is.
struct SegmentTools {
  const RobotKit& robot;
  const MissionOptions& options;
  Perception& perception;
  FrameTaker& camera;
  ArmMover& arm;
  FramesOnTheWay& frames;
  Timekeeper& time;
  EventHub& events;
  MissionCursor& cursor;
  /// When each segment has to be over, mission time, s, the last one with the mission; empty: each
  /// has its own clock.
  const std::vector<double>& deadlines_s;
};

/// One segment: the arm stands at its home state, the trolley at its stop. Senses, maps, plans and
/// acts step by step until the time is up ([Zaenker23], Fig. 2), or by other rules
/// (MissionOptions) until it is over.
class SegmentRunner {
 public:
  /// What `tools` points to outlives it.
  SegmentRunner(const SegmentTools& tools, int index);
  SegmentRunner(const SegmentRunner&) = delete;
  SegmentRunner& operator=(const SegmentRunner&) = delete;
  ~SegmentRunner() {
    rest();
    tools_.frames.plan_with({});
  }

  /// The planner is told of the segment, the first frame is taken.
  [[nodiscard]] Expected<void> begin();
  /// In place of begin(): goes on in the middle, with the planner's state of then.
  [[nodiscard]] Expected<void> resume(std::string_view planner_state);
  /// One decision of the planner, and what it leads to: a motion with a frame at its end, a wait, a
  /// move home.
  [[nodiscard]] Expected<void> step();
  /// By time or views; without a time limit also when nothing comes of it any more.
  [[nodiscard]] bool is_over() const;
  /// What is said when it begins.
  [[nodiscard]] SegmentEvent event() const;
  /// A motion under way when the time was up has been finished; its frame belongs to the
  /// transition. The planner's background work stops: what it knows is about to be forgotten.
  [[nodiscard]] Expected<void> end();
  [[nodiscard]] Expected<MotionEnd> go_home(const Configuration& home);

 private:
  void rest() { tools_.time.background().rest(); }
  void stand_at(const TrolleyState& trolley);
  /// Infinite: no limit.
  [[nodiscard]] double budget_s() const;
  [[nodiscard]] bool unlimited() const;
  [[nodiscard]] int max_views() const;
  [[nodiscard]] bool time_is_up() const;
  /// What is seen now does not count any more.
  [[nodiscard]] bool mission_is_over() const;
  [[nodiscard]] PlanningScene planning_scene() const;
  [[nodiscard]] Expected<void> observe(TargetKind kind, std::optional<std::int64_t> predicted);
  [[nodiscard]] ViewEvent view_event(const Look& look, TargetKind kind,
                                     std::optional<std::int64_t> predicted);
  [[nodiscard]] Expected<void> tell(const Look& look, ViewEvent view);
  [[nodiscard]] Expected<void> take(const ViewMotion& motion);
  [[nodiscard]] Expected<void> drive(const RowDrive& drive);
  void wait_for_planner(int questions);
  [[nodiscard]] Expected<void> recover();
  [[nodiscard]] std::shared_ptr<const MapSnapshot> snapshot() const;
  Decision decide();

  SegmentTools tools_;
  int index_;
  SegmentFrame frame_;
  CollisionChecker checker_;
};

}  // namespace canopeer
