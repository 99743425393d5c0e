#include "canopeer/mission/segment/segment_runner.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "canopeer/mission/mission_time.h"

namespace canopeer {
namespace {

constexpr double kWaitStep = 0.05;  // s between two questions to a planner that waits
constexpr int kStuckWaits = 20;     // that many such questions are a second
constexpr double kAtHome = 0.1;     // rad, Σ|Δq|: more than an arm misses its goal by

/// `trolley`: where it really stands, which may be beside the plan where a person pushes it.
SegmentFrame segment_frame(const RobotModel& robot, const SegmentPlan& plan, int index,
                           const TrolleyState& trolley) {
  SegmentFrame frame;
  frame.index = index;
  frame.trolley = trolley;
  frame.T_world_base = robot.T_world_base(trolley);
  frame.workspace_base = robot.workspace(plan.side);
  frame.sampling_region_world = transformed(robot.sampling_region(plan.side), frame.T_world_base);
  frame.home = robot.home("side_" + std::to_string(plan.side));
  frame.row = plan.row;
  return frame;
}

}  // namespace

SegmentRunner::SegmentRunner(const SegmentTools& tools, int index)
    : tools_(tools),
      index_(index),
      frame_(segment_frame(tools.robot.model,
                           tools.options.segments[static_cast<std::size_t>(index)], index,
                           tools.arm.trolley())),
      checker_(tools.robot.model, frame_.trolley, tools.options.collision) {
  stand_at(frame_.trolley);
}

/// Distances and checks are wanted around where the trolley stands now.
void SegmentRunner::stand_at(const TrolleyState& trolley) {
  const RobotModel& robot = tools_.robot.model;
  tools_.time.background().alone([&](Planner&) {
    frame_ = segment_frame(robot, tools_.options.segments[static_cast<std::size_t>(index_)], index_,
                           trolley);
    checker_ = CollisionChecker(robot, trolley, tools_.options.collision);
    const Box& known_free = robot.setup().known_free;
    tools_.perception.move_field(
        frame_.T_world_base.translation(),
        known_free.isEmpty() ? known_free : transformed(known_free, frame_.T_world_base));
    checker_.set_map(&tools_.perception.field());
  });
  tools_.frames.plan_with({frame_.sampling_region_world, [this] { return snapshot(); }});
}

Expected<void> SegmentRunner::begin() {
  MissionCursor& cursor = tools_.cursor;
  tools_.time.book(&TimeSplit::transitions_s);
  cursor.course.begin(tools_.perception.map().observed_voxels());
  cursor.segment_start_s = cursor.standing_since_s = tools_.time.now_s();
  cursor.last_standing_s = cursor.last_motion_s = 0.0;
  if (auto ok = tools_.events.emit(SegmentBegun{event()}); !ok) return ok;

  const PlanningScene scene = planning_scene();
  tools_.time.background().alone([&](Planner& planner) { planner.begin_segment(scene); });
  tools_.time.background().go();
  return observe(TargetKind::none, std::nullopt);
}

SegmentEvent SegmentRunner::event() const {
  SegmentEvent segment;
  segment.segment = index_;
  segment.name = tools_.options.segments[static_cast<std::size_t>(index_)].name;
  segment.start_s = tools_.cursor.segment_start_s;
  segment.sampling_region_world = frame_.sampling_region_world;
  segment.workspace_world = transformed(frame_.workspace_base, frame_.T_world_base);
  return segment;
}

Expected<void> SegmentRunner::resume(std::string_view planner_state) {
  const PlanningScene scene = planning_scene();
  auto restored = tools_.time.background().alone(
      [&](Planner& planner) { return planner.restore(scene, planner_state); });
  if (!restored) return fail_in("planner", restored.error());
  // Behind its last decision a segment has nothing to plan for.
  if (tools_.cursor.next == MissionCursor::Step::decide) {
    tools_.time.background().go();
  } else {
    tools_.frames.plan_with({});
  }
  return {};
}

PlanningScene SegmentRunner::planning_scene() const {
  PlanningScene scene;
  scene.robot = &tools_.robot.model;
  scene.ik = &tools_.robot.ik;
  scene.map = &tools_.perception.map();
  scene.checker = &checker_;
  scene.judge = &tools_.robot.judge;
  scene.costs = &tools_.options.costs;
  scene.snapshot = snapshot();
  scene.segment = frame_;
  scene.seed = tools_.options.seed;
  scene.time_left_s = budget_s() - (tools_.time.now_s() - tools_.cursor.segment_start_s);
  scene.looks_on_the_way = tools_.frames.wanted();
  scene.sharp = tools_.options.on_the_way.limit();
  return scene;
}

double SegmentRunner::budget_s() const {
  const auto index = static_cast<std::size_t>(index_);
  const double began_s = tools_.cursor.segment_start_s - tools_.cursor.held_s;
  if (!tools_.deadlines_s.empty()) {
    return tools_.options.shares_time
               ? shared_time_s(tools_.robot.model, tools_.options, index_, began_s)
               : tools_.deadlines_s[index] - began_s;
  }
  const double own_s = tools_.options.segments[index].time_s;
  const double limit_s = own_s > 0.0 ? own_s : tools_.options.segment_time_s;
  return limit_s > 0.0 ? limit_s : std::numeric_limits<double>::infinity();
}

bool SegmentRunner::unlimited() const {
  return budget_s() == std::numeric_limits<double>::infinity();
}

int SegmentRunner::max_views() const {
  const int own = tools_.options.segments[static_cast<std::size_t>(index_)].max_views;
  return own > 0 ? own : tools_.options.max_views;
}

bool SegmentRunner::is_over() const {
  const SegmentCourse& course = tools_.cursor.course;
  if (time_is_up()) return true;
  if (max_views() > 0) return course.views() >= max_views();
  return unlimited() && course.exhausted();
}

bool SegmentRunner::time_is_up() const {
  return tools_.time.now_s() - tools_.cursor.segment_start_s >= budget_s();
}

bool SegmentRunner::mission_is_over() const {
  return !tools_.deadlines_s.empty() &&
         tools_.time.now_s() >= tools_.deadlines_s.back() + tools_.cursor.held_s;
}

Expected<void> SegmentRunner::step() {
  const Decision decision = decide();
  switch (decision.action) {
    case Decision::Action::move:
      tools_.cursor.course.went_on();
      return take(decision.motion);
    case Decision::Action::wait:
      wait_for_planner(1);
      return {};
    case Decision::Action::stuck:
      return recover();
    case Decision::Action::drive:
      tools_.cursor.course.went_on();
      return drive(decision.drive);
    case Decision::Action::done:
      tools_.cursor.skip = tools_.options.leave_when_done;
      if (!tools_.cursor.skip) wait_for_planner(1);
      return {};
  }
  return {};
}

/// Without a time limit not for ever.
void SegmentRunner::wait_for_planner(int questions) {
  tools_.cursor.course.waited(questions);
  if (unlimited() && tools_.cursor.course.waits_for_good()) tools_.cursor.skip = true;
  tools_.time.pass(questions * kWaitStep);
  tools_.time.book(&TimeSplit::waiting_s);
}

Expected<void> SegmentRunner::end() {
  rest();
  tools_.frames.plan_with({});
  // One that begins behind its deadline has no time at all.
  const double latest_s = tools_.cursor.segment_start_s + std::max(0.0, budget_s());
  SegmentEnded ended{index_, std::min(tools_.time.now_s(), latest_s)};
  if (tools_.events.needs().surface) {
    ended.surface = std::make_shared<const SurfaceMesh>(tools_.perception.fruits().surface());
  }
  return tools_.events.emit(std::move(ended));
}

Expected<MotionEnd> SegmentRunner::go_home(const Configuration& home) {
  return tools_.arm.go_home(home, checker_);
}

/// What tasks in other threads may read while the next frame is fused.
std::shared_ptr<const MapSnapshot> SegmentRunner::snapshot() const {
  if (!tools_.time.background().has_workers()) return nullptr;
  return std::make_shared<const MapSnapshot>(tools_.perception.map(), tools_.perception.field(),
                                             checker_);
}

/// A frame from where the arm stands: fused, told to everybody and to the planner, paid for.
Expected<void> SegmentRunner::observe(TargetKind kind, std::optional<std::int64_t> predicted) {
  if (mission_is_over()) return {};
  WorkMeter work;
  auto look = tools_.camera.look(frame_.sampling_region_world, predicted.has_value(), work,
                                 tools_.time.timer());
  if (!look) return tl::unexpected(look.error());
  if (auto ok = tell(*look, view_event(*look, kind, predicted)); !ok) return ok;
  MapChange& change = look->seen.change;
  change.snapshot = snapshot();
  tools_.time.timer().time("planner: new map", [&] {
    tools_.time.background().beside(
        [&](Planner& planner) { planner.map_changed(std::move(change)); });
  });
  tools_.time.pay(work);
  tools_.time.book(&TimeSplit::mapping_s);
  tools_.cursor.course.viewed(tools_.perception.map().observed_voxels());
  return {};
}

ViewEvent SegmentRunner::view_event(const Look& look, TargetKind kind,
                                    std::optional<std::int64_t> predicted) {
  const Configuration q = tools_.arm.where();
  ViewEvent view;
  view.segment = index_;
  view.view = tools_.cursor.views++;
  view.t_s = look.frame->time_s;
  view.planning_s = tools_.cursor.last_standing_s;
  view.motion_s = tools_.cursor.last_motion_s;
  view.q.assign(q.data(), q.data() + q.size());
  view.T_world_camera = look.frame->T_world_camera;
  view.target_kind = target_kind_name(kind);
  if (predicted) view.predicted_gain = static_cast<double>(*predicted);
  view.realised_gain = look.seen.fused.newly_known;
  view.realised_in_fan = look.realised_in_fan;
  view.fused_points = look.seen.fused.fused_points;
  if (const auto& pixels = look.seen.pixels) {
    view.pixels =
        PixelHits{pixels->true_positives, pixels->false_positives, pixels->false_negatives};
  }
  view.roi_voxels = tools_.perception.map().roi_voxels();
  const PlannerStatus status =
      tools_.time.background().beside([](Planner& planner) { return planner.status(); });
  view.graph_nodes = status.graph_nodes;
  view.graph_edges = status.graph_edges;
  for (const auto& fruit : tools_.perception.fruits().fruits()) {
    view.fruits.push_back({fruit.id, fruit.centre, fruit.volume_cm3, fruit.confidence});
  }
  return view;
}

Expected<void> SegmentRunner::tell(const Look& look, ViewEvent view) {
  const double t_s = view.t_s;
  const int number = view.view;
  EventHub& events = tools_.events;
  if (auto ok = events.emit(FrameTaken{std::move(view), look.frame, look.detection}); !ok) {
    return ok;
  }
  MapChanged change{t_s, number, look.seen.change.blocks, nullptr, nullptr};
  if (events.needs().map) {
    change.targets = std::make_shared<const FrontierTargets>(look.seen.change.targets);
    change.map = std::make_shared<const VoxelMap>(tools_.perception.map());
  }
  if (auto ok = events.emit(std::move(change)); !ok) return ok;
  return events.emit(FruitsFound{t_s, number, tools_.perception.fruits().fruits()});
}

Decision SegmentRunner::decide() {
  WorkMeter work;
  Decision decision = tools_.time.timer().time("planner: search", [&] {
    return tools_.time.background().beside(
        [&](Planner& planner) { return planner.decide(tools_.arm.where(), work); });
  });
  tools_.time.pay(work);
  tools_.time.book(&TimeSplit::planning_s);
  return decision;
}

Expected<void> SegmentRunner::take(const ViewMotion& motion) {
  Planned planned{
      tools_.time.now_s(),   index_, motion.waypoints, motion.T_world_camera, motion.kind,
      motion.predicted_gain, nullptr};
  if (tools_.events.needs().plan) {
    planned.sketch = std::make_shared<const PlanSketch>(
        tools_.time.background().beside([](Planner& planner) { return planner.sketch(); }));
  }
  if (auto ok = tools_.events.emit(std::move(planned)); !ok) return ok;
  const auto end = tools_.arm.move("view", motion.waypoints, checker_);
  if (!end) return tl::unexpected(end.error());
  tools_.time.book(&TimeSplit::execution_s);
  if (*end == MotionEnd::arrived) return observe(motion.kind, motion.predicted_gain);
  // Where it stands is a place as good as another, but twice in a row asks for another way.
  if (tools_.cursor.missed_motions > 1) return recover();
  return observe(motion.kind, std::nullopt);
}

/// The trolley drives with the arm as it is, and the planner is told where it is now.
Expected<void> SegmentRunner::drive(const RowDrive& drive) {
  if (auto ok = tools_.arm.drive({drive.goal, drive.max_travel_m_s, true}); !ok) return ok;
  tools_.time.book(&TimeSplit::execution_s);
  stand_at(tools_.arm.trolley());
  const PlanningScene scene = planning_scene();
  tools_.time.background().alone([&](Planner& planner) { planner.moved(scene); });
  return observe(TargetKind::none, std::nullopt);
}

/// The planner knows no way on. At another place it may: home is one that can always be reached.
Expected<void> SegmentRunner::recover() {
  const EndlessJoints& endless = tools_.robot.model.endless();
  if (endless.distance(tools_.arm.where(), frame_.home) < kAtHome) {
    wait_for_planner(kStuckWaits);
    return {};
  }
  if (auto end = go_home(frame_.home); !end) return tl::unexpected(end.error());
  tools_.time.book(&TimeSplit::execution_s);
  return observe(TargetKind::none, std::nullopt);
}

}  // namespace canopeer
