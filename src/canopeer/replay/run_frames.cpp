#include "canopeer/replay/run_frames.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "canopeer/replay/frames/frame_head.h"
#include "canopeer/replay/frames/happening_frames.h"
#include "canopeer/replay/frames/map_frames.h"
#include "canopeer/replay/frames/picture_frames.h"
#include "canopeer/replay/frames/plan_frames.h"
#include "canopeer/replay/frames/still_frames.h"
#include "canopeer/replay/frames/surface_frames.h"

namespace canopeer {

using namespace frames;

namespace {

// Seconds between two tellings of what frames on the way changed. It changes four times a second,
// mostly in the same places.
constexpr double kTellEvery = 2.0;

bool same_pinhole(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

}  // namespace

struct RunFrames::State {
  explicit State(const RobotModel& its_robot) : robot(its_robot) {}

  RunStory story;
  RobotModel robot;
  std::vector<Frame> first;
  MapFrames map;
  PlanFrames plan;
  FruitFrames fruit;
  SurfaceFrames surface;

  /// What frames on the way changed and nobody was told yet.
  struct Held {
    std::set<BlockKey> blocks;
    std::optional<MapChanged> map;
    std::optional<FruitsFound> fruits;
  };
  Held held;
  bool on_the_way = false;  // the last frame was
  double told_s = -kTellEvery;

  [[nodiscard]] bool waits(double t_s) const {
    return on_the_way && t_s > told_s && t_s < told_s + kTellEvery;
  }
  std::vector<Frame> map_now(const MapChanged& change) {
    held.map.reset();
    const std::set<BlockKey> blocks = std::exchange(held.blocks, {});
    told_s = change.t_s;
    std::vector<Frame> all;
    if (change.map) {
      all.push_back(map.map(change.view, change.t_s, *change.map, {blocks.begin(), blocks.end()}));
    }
    if (change.targets) all.push_back(map.targets(change.view, *change.targets));
    return all;
  }
  std::vector<Frame> fruits_now(const FruitsFound& found) {
    held.fruits.reset();
    told_s = found.t_s;
    return {fruit.fruits(found)};
  }
  std::vector<Frame> all_held() {
    std::vector<Frame> all;
    if (held.map) all = map_now(MapChanged(*held.map));
    if (held.fruits) all.push_back(fruit.fruits(*std::exchange(held.fruits, {})));
    return all;
  }

  std::optional<TrolleyState> driven_to;  ///< since the run began

  /// Where it stands; before the first drive: at the segment's stop.
  [[nodiscard]] TrolleyState trolley(int segment) const {
    if (driven_to) return *driven_to;
    const auto index = static_cast<std::size_t>(std::max(segment, 0));
    return index < story.segments.size() ? story.segments[index].trolley : TrolleyState{};
  }

  std::vector<Frame> frames(const RunBegun& begun) const {
    if (!begun.resumed) return {};
    return {log_frame(begun.t_s, "info", "The run goes on.")};
  }
  std::vector<Frame> frames(const SegmentBegun& begun) const {
    return {segment_frame(begun.segment, trolley(begun.segment.segment))};
  }
  std::vector<Frame> frames(const SegmentEnded& ended) {
    if (!ended.surface) return {};
    return surface.surface(ended.end_s, *ended.surface);
  }
  std::vector<Frame> frames(const FrameTaken& taken) {
    on_the_way = false;
    const CameraIntrinsics& camera = taken.frame->intrinsics;
    const bool other = !same_pinhole(camera, story.camera);
    story.camera = camera;
    std::vector<Frame> all = picture_frames(taken.view.view, *taken.frame, *taken.detection);
    all.insert(all.begin(),
               view_frame(taken.view, trolley(taken.view.segment), other ? &camera : nullptr));
    return all;
  }
  /// Without pictures: fruits and map tell what several of them changed.
  std::vector<Frame> frames(const FrameOnTheWay& taken) {
    on_the_way = true;
    return {look_frame(taken.frame)};
  }
  std::vector<Frame> frames(const MapChanged& change) {
    held.blocks.insert(change.blocks.begin(), change.blocks.end());
    if (!waits(change.t_s)) return map_now(change);
    held.map = change;
    return {};
  }
  std::vector<Frame> frames(const FruitsFound& found) {
    if (!waits(found.t_s)) return fruits_now(found);
    held.fruits = found;
    return {};
  }
  std::vector<Frame> frames(const Planned& planned) {
    if (!planned.sketch) return {};
    return {plan.plan(planned)};
  }
  std::vector<Frame> frames(const MotionBegun& motion) const {
    return {motion_frame(motion, robot)};
  }
  std::vector<Frame> frames(const MotionEnded& ended) {
    const MotionEvent& motion = ended.motion;
    if (motion.kind == "trolley") {
      if (motion.trolley.size() == 2) driven_to = {motion.trolley[0], motion.trolley[1]};
      return {trolley_frame(motion, trolley(motion.segment))};
    }
    return {motion_end_frame(motion)};
  }
  std::vector<Frame> frames(const Fault& fault) const {
    return {log_frame(fault.t_s, "fault", fault.message)};
  }
  std::vector<Frame> frames(const Steered& steered) const {
    std::string text(steering_name(steered.word.kind));
    std::replace(text.begin(), text.end(), '_', ' ');
    if (!steered.word.by.empty()) text += ", said " + steered.word.by;
    if (!steered.word.why.empty()) text += ": " + steered.word.why;
    return {log_frame(steered.t_s, "notice", text, steering_name(steered.word.kind))};
  }
  std::vector<Frame> frames(const WorkDone& done) const { return {work_frame(done.work)}; }
  std::vector<Frame> frames(const RunEnded& end) {
    std::vector<Frame> all = all_held();
    if (end.surface) {
      for (Frame& frame : surface.surface(end.end_s, *end.surface)) all.push_back(std::move(frame));
    }
    all.push_back(end_frame(end));
    return all;
  }
};

namespace {

Frame hello_frame(const RunStory& story) {
  Json head = head_of("hello");
  head["protocol"] = 1;
  head["mission"] = story.mission;
  head["planner"] = story.planner;
  head["seed"] = story.seed;
  head["canopeer"] = story.canopeer_version;
  head["simulated"] = story.simulated;
  head["segments"] = story.segments.size();
  head["segment_time_s"] = story.segment_time_s;
  head["resolution_m"] = story.resolution_m;
  return frame_of(head);
}

}  // namespace

RunFrames::RunFrames(RunStory story, const RobotModel& robot, const Scene* truth)
    : state_(std::make_unique<State>(robot)) {
  state_->first = {hello_frame(story), robot_frame(robot, story.camera)};
  if (truth != nullptr) state_->first.push_back(truth_frame(*truth));
  state_->story = std::move(story);
}
RunFrames::~RunFrames() = default;

std::vector<Frame> RunFrames::first() const { return state_->first; }

std::vector<Frame> RunFrames::of(const Event& event) {
  return std::visit([&](const auto& one) { return state_->frames(one); }, event);
}

void RunFrames::missed() { state_->map.missed(); }

}  // namespace canopeer
