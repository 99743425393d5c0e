#include "canopeer/mission/segment_runner.h"

#include <algorithm>
#include <utility>

#include "canopeer/robot/corner_rounding.h"

namespace canopeer {
namespace {

constexpr double kWaitStep = 0.05;  // s between two questions to a planner that waits
constexpr double kAtHome = 0.1;     // rad, Σ|Δq|: more than an arm misses its goal by

std::vector<double> to_vector(const Configuration& q) { return {q.data(), q.data() + q.size()}; }

SegmentFrame segment_frame(const RobotModel& robot, const SegmentPlan& plan, int index) {
  SegmentFrame frame;
  frame.index = index;
  frame.trolley = plan.trolley;
  frame.T_world_base = robot.T_world_base(plan.trolley);
  frame.workspace_base = robot.workspace(plan.side);
  frame.sampling_region_world = transformed(robot.sampling_region(plan.side), frame.T_world_base);
  frame.home = robot.home("side_" + std::to_string(plan.side));
  return frame;
}

}  // namespace

SegmentRunner::SegmentRunner(MissionContext& context, int index)
    : context_(context),
      index_(index),
      frame_(segment_frame(context.robot, context.options.segments[static_cast<std::size_t>(index)],
                           index)),
      checker_(context.robot, frame_.trolley, context.options.collision),
      self_filter_(context.robot, context.options.self_filter) {
  const Box& known_free = context_.robot.setup().known_free;
  context_.background.alone([&] {
    context_.perception.move_field(
        frame_.T_world_base.translation(),
        known_free.isEmpty() ? known_free : transformed(known_free, frame_.T_world_base));
    checker_.set_map(&context_.perception.field());
  });
}

Expected<void> SegmentRunner::run(const Configuration& home_after) {
  const Clock& clock = *context_.ports.clock;
  start_s_ = standing_since_s_ = clock.now_s();
  SegmentEvent event;
  event.segment = index_;
  event.name = context_.options.segments[static_cast<std::size_t>(index_)].name;
  event.start_s = start_s_;
  event.sampling_region_world = frame_.sampling_region_world;
  event.workspace_world = transformed(frame_.workspace_base, frame_.T_world_base);
  context_.record.segments.push_back(event);
  if (auto ok = context_.writer.begin_segment(event); !ok) return ok;

  PlanningScene scene;
  scene.robot = &context_.robot;
  scene.ik = &context_.ik;
  scene.map = &context_.perception.map();
  scene.checker = &checker_;
  scene.judge = &context_.judge;
  scene.costs = &context_.options.costs;
  scene.snapshot = snapshot();
  scene.segment = frame_;
  scene.seed = context_.options.seed;
  context_.background.alone([&] { context_.planner.begin_segment(scene); });
  context_.background.go();

  if (auto ok = observe(TargetKind::none, std::nullopt); !ok) return ok;
  while (clock.now_s() - start_s_ < context_.options.segment_time_s && !context_.stop) {
    const Decision decision = decide();
    Expected<void> ok;
    switch (decision.action) {
      case Decision::Action::move:
        ok = take(decision.motion);
        break;
      case Decision::Action::wait:
        pass(kWaitStep);
        break;
      case Decision::Action::stuck:
        ok = recover();
        break;
    }
    if (!ok) return ok;
  }
  // A motion under way when the time was up has been finished; its frame belongs to the transition.
  const double end_s = std::min(clock.now_s(), start_s_ + context_.options.segment_time_s);
  context_.record.segments.back().end_s = end_s;
  if (auto ok = context_.writer.end_segment(index_, end_s); !ok) return ok;
  return go_home(home_after);
}

/// What tasks in other threads may read while the next frame is fused.
std::shared_ptr<const MapSnapshot> SegmentRunner::snapshot() const {
  if (!context_.background.has_workers()) return nullptr;
  return std::make_shared<const MapSnapshot>(context_.perception.map(), context_.perception.field(),
                                             checker_);
}

/// A frame from where the arm stands: fused, charged, recorded, told to the planner.
Expected<void> SegmentRunner::observe(TargetKind kind, std::optional<std::int64_t> predicted) {
  auto frame = context_.timer.time("camera", [&] { return context_.ports.camera->capture(); });
  if (!frame) return fail_in("camera", frame.error());
  if (context_.options.mask_robot) {
    self_filter_.mask(*frame, context_.ports.arm->configuration(), context_.ports.trolley->state());
  }
  WorkMeter work;
  auto observed =
      context_.perception.observe(*frame, frame_.sampling_region_world, work, context_.timer);
  if (!observed) return tl::unexpected(observed.error());
  Observation& seen = *observed;
  seen.change.snapshot = snapshot();
  ViewEvent view;
  view.segment = index_;
  view.view = static_cast<int>(context_.record.views.size());
  view.t_s = frame->time_s;
  view.planning_s = last_standing_s_;
  view.motion_s = last_motion_s_;
  view.q = to_vector(context_.ports.arm->configuration());
  view.T_world_camera = frame->T_world_camera;
  view.target_kind = target_kind_name(kind);
  if (predicted) view.predicted_gain = static_cast<double>(*predicted);
  view.realised_gain = seen.fused.newly_known;
  view.fused_points = seen.fused.fused_points;
  if (seen.pixels) {
    view.pixels = PixelHits{seen.pixels->true_positives, seen.pixels->false_positives,
                            seen.pixels->false_negatives};
  }
  view.roi_voxels = context_.perception.map().roi_voxels();
  const PlannerStatus status =
      context_.background.beside([&] { return context_.planner.status(); });
  view.graph_nodes = status.graph_nodes;
  view.graph_edges = status.graph_edges;
  for (const auto& fruit : context_.perception.fruits().fruits()) {
    view.fruits.push_back({fruit.id, fruit.centre, fruit.volume_cm3, fruit.confidence});
  }
  if (auto ok = context_.writer.add(view); !ok) return ok;
  context_.record.views.push_back(std::move(view));
  report_progress();

  context_.timer.time("planner: new map", [&] {
    context_.background.beside([&] { context_.planner.map_changed(std::move(seen.change)); });
  });
  pay(work);
  return {};
}

Decision SegmentRunner::decide() {
  WorkMeter work;
  const Decision decision = context_.timer.time("planner: search", [&] {
    return context_.background.beside(
        [&] { return context_.planner.decide(context_.ports.arm->configuration(), work); });
  });
  pay(work);
  return decision;
}

Expected<void> SegmentRunner::take(const ViewMotion& motion) {
  if (auto ok = move("view", motion.waypoints); !ok) return ok;
  return observe(motion.kind, motion.predicted_gain);
}

/// A motion of the arm, with the graph growing meanwhile. It stops where it must only: corners are
/// rounded as far as the map allows.
Expected<void> SegmentRunner::move(const std::string& kind,
                                   const std::vector<Configuration>& waypoints) {
  Clock& clock = *context_.ports.clock;
  Arm& arm = *context_.ports.arm;
  const JointPath path = without_needless_stops(waypoints);
  MotionEvent event;
  event.kind = kind;
  event.segment = index_;
  event.start_s = clock.now_s();
  for (const auto& q : waypoints) event.waypoints.push_back(to_vector(q));
  event.deviations = path.deviations;
  const std::vector<Configuration> points = points_along(path);
  for (std::size_t i = 1; i < points.size(); ++i) {
    event.joint_path_rad += joint_distance(points[i - 1], points[i]);
  }
  const auto duration = context_.timer.time("arm", [&] { return arm.start(path); });
  if (!duration) return fail_in("arm", duration.error());
  context_.timer.time("planner: graph", [&] { context_.background.time_passes(*duration); });
  const auto outcome = context_.timer.time("arm", [&] { return arm.finish(); });
  if (!outcome) return fail_in("arm", outcome.error());
  context_.traveller.took(waypoints);
  event.duration_s = clock.now_s() - event.start_s;
  event.collision = outcome->collision;
  event.plant_contact = outcome->plant_contact;
  last_standing_s_ = event.start_s - standing_since_s_;
  last_motion_s_ = event.duration_s;
  standing_since_s_ = clock.now_s();
  if (auto ok = context_.writer.add(event); !ok) return ok;
  context_.record.motions.push_back(std::move(event));
  return {};
}

JointPath SegmentRunner::without_needless_stops(const std::vector<Configuration>& waypoints) {
  if (waypoints.size() < 3) return {waypoints};
  int states = 0;
  JointPath path = context_.timer.time(
      "arm", [&] { return round_corners(waypoints, context_.robot.limits(), checker_, states); });
  WorkMeter work;
  work.add(Work::motion_plan, states);
  pay(work);
  return path;
}

Expected<void> SegmentRunner::go_home(const Configuration& home) {
  WorkMeter work;
  const auto way = context_.timer.time("way home", [&] {
    return context_.traveller.way_home(context_.ports.arm->configuration(), home, checker_, work);
  });
  pay(work);
  if (way.size() > 1) {
    if (auto ok = move("home", way); !ok) return ok;
  }
  if (joint_distance(way.back(), home) > 1e-9) {
    return fail("segment " + std::to_string(index_) +
                ": no collision-free way home was found; is the home state of the next segment "
                "blocked by plants?");
  }
  context_.traveller.forget_way(context_.ports.arm->configuration());
  return {};
}

/// The planner knows no way on. At another place it may: home is one that can always be reached.
Expected<void> SegmentRunner::recover() {
  const double away = joint_distance(context_.ports.arm->configuration(), frame_.home);
  if (away < kAtHome) {
    pass(1.0);
    return {};
  }
  if (auto ok = go_home(frame_.home); !ok) return ok;
  return observe(TargetKind::none, std::nullopt);
}

/// Foreground work costs mission time; the background goes on in it.
void SegmentRunner::pay(const WorkMeter& work) {
  context_.foreground.merge(work);
  const double seconds = work.seconds(context_.options.costs);
  context_.ports.clock->charge(seconds);
  context_.timer.time("planner: graph", [&] { context_.background.time_passes(seconds); });
}

void SegmentRunner::pass(double seconds) {
  context_.ports.clock->sleep(seconds);
  context_.timer.time("planner: graph", [&] { context_.background.time_passes(seconds); });
}

void SegmentRunner::report_progress() const {
  if (!context_.progress) return;
  const auto segments = static_cast<int>(context_.options.segments.size());
  const double now_s = context_.ports.clock->now_s();
  const double done = std::min(1.0, (now_s - start_s_) / context_.options.segment_time_s);
  MissionProgress progress;
  progress.segment = index_;
  progress.segments = segments;
  progress.time_s = now_s;
  progress.fraction = (index_ + done) / segments;
  progress.views = static_cast<int>(context_.record.views.size());
  progress.fruits = static_cast<int>(context_.perception.fruits().fruits().size());
  context_.progress(progress);
}

}  // namespace canopeer
