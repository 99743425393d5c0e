#include "canopeer/mission/segment/frames_on_the_way.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "canopeer/sensing/camera_twist.h"

namespace canopeer {
namespace {

constexpr std::chrono::milliseconds kNextLook(3);  // for frames, on the wall clock
constexpr double kJustSharp = 1.02;                // who moves at the limit keeps to it

/// Of every 16th pixel each way; 0: it shows nothing.
double median_depth_m(const DepthImage& depth) {
  std::vector<float> seen;
  for (int v = 8; v < depth.height(); v += 16) {
    for (int u = 8; u < depth.width(); u += 16) {
      if (depth.at(u, v) > 0.0F) seen.push_back(depth.at(u, v));
    }
  }
  if (seen.empty()) return 0.0;
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  return *middle;
}

}  // namespace

FramesOnTheWay::FramesOnTheWay(const RobotModel& robot, const Ports& ports,
                               const MissionOptions& options, Perception& perception,
                               Timekeeper& time, EventHub& events, MissionCursor& cursor)
    : robot_(robot),
      ports_(ports),
      options_(options),
      perception_(perception),
      time_(time),
      events_(events),
      cursor_(cursor),
      self_filter_(robot, options.self_filter) {}

FramesOnTheWay::~FramesOnTheWay() = default;

/// After the mission's time nothing counts any more.
bool FramesOnTheWay::counts() const {
  return wanted() && (options_.mission_time_s <= 0.0 || time_.now_s() < end_s());
}

Expected<void> FramesOnTheWay::set_out(const std::string& during) {
  counts_ = FrameCounts();
  open_ = counts();
  if (!open_) return {};
  during_ = during;
  arrived_s_ = std::numeric_limits<double>::infinity();
  T_last_ = robot_.T_world_base(ports_.trolley->state()) *
            robot_.T_base_camera(ports_.arm->configuration());
  if (auto ok = ports_.camera->stream(options_.on_the_way.hz); !ok) {
    return fail_in("camera", ok.error());
  }
  free_s_ = time_.now_s();
  if (!time_.simulated()) {
    thread_ = std::jthread([this](const std::stop_token& stop) { work_until_told(stop); });
  }
  return {};
}

Expected<void> FramesOnTheWay::go_along(double duration_s) {
  if (!open_ || !time_.simulated()) {
    time_.goes_on(duration_s);
    return {};
  }
  const int slices =
      std::max(1, static_cast<int>(std::ceil(duration_s / options_.on_the_way.tell_every_s)));
  for (int i = 0; i < slices; ++i) {
    if (during_ == "trolley") {
      ports_.clock->sleep(duration_s / slices);  // nobody plans for where it leaves from
    } else {
      time_.pass(duration_s / slices);
    }
    if (auto ok = fetch(); !ok) return ok;
    if (auto ok = work_off(time_.now_s()); !ok) return ok;
    if (free_s_ > time_.now_s()) continue;  // the last one is not done yet
    if (auto ok = tell(); !ok) return ok;
  }
  return {};
}

void FramesOnTheWay::abandon() {
  open_ = false;
  stop_thread();
  failure_ = {};
  waiting_.clear();
}

void FramesOnTheWay::stop_thread() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
}

Expected<std::optional<FrameCounts>> FramesOnTheWay::arrive() {
  if (!open_) return std::optional<FrameCounts>();
  open_ = false;
  arrived_s_ = time_.now_s();
  stop_thread();
  if (!failure_) return tl::unexpected(std::exchange(failure_, {}).error());
  if (auto ok = fetch(); !ok) return tl::unexpected(ok.error());
  if (auto ok = work_off(std::numeric_limits<double>::infinity()); !ok) {
    return tl::unexpected(ok.error());
  }
  if (auto ok = tell(); !ok) return tl::unexpected(ok.error());
  if (time_.simulated()) ports_.clock->sleep(std::max(0.0, free_s_ - time_.now_s()));
  if (auto ok = ports_.camera->stream(0.0); !ok) return tl::unexpected(ok.error());
  time_.timer().add(std::exchange(stages_, {}));
  return std::optional(counts_);
}

/// On the wall clock: frames as they come, one after the other.
void FramesOnTheWay::work_until_told(const std::stop_token& stop) {
  double told_s = time_.now_s();
  try {
    while (!stop.stop_requested()) {
      failure_ = fetch();
      if (failure_ && !waiting_.empty()) {
        const Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        failure_ = take_in(next);
      } else {
        std::this_thread::sleep_for(kNextLook);
      }
      if (failure_ && time_.now_s() - told_s >= options_.on_the_way.tell_every_s) {
        told_s = time_.now_s();
        failure_ = tell();
      }
      if (!failure_) return;
    }
  } catch (const std::exception& error) {
    failure_ = fail(std::string("an exception: ") + error.what());
  }
}

Expected<void> FramesOnTheWay::fetch() {
  auto frames = ports_.camera->arrived();
  if (!frames) return fail_in("camera", frames.error());
  for (StreamedFrame& frame : *frames) {
    // Until this one came, those before it were worked on.
    if (time_.simulated()) {
      if (auto ok = work_off(frame.arrived_s); !ok) return ok;
    }
    admit(std::move(frame));
  }
  return {};
}

void FramesOnTheWay::admit(StreamedFrame frame) {
  if (frame.time_s > arrived_s_) return;  // from rest: the next view is from there
  if (options_.mission_time_s > 0.0 && frame.time_s > end_s()) return;
  const double blur = blur_px(frame);
  const double limit_px = options_.on_the_way.max_blur_px;
  if (alike(frame)) {
    ++counts_.alike;
  } else if (limit_px > 0.0 && blur > limit_px * kJustSharp) {
    ++counts_.blurred;
  } else if (static_cast<int>(waiting_.size()) >= options_.on_the_way.queue) {
    ++counts_.late;
  } else {
    T_last_ = frame.T_world_camera;
    waiting_.push_back({std::move(frame), blur});
  }
}

bool FramesOnTheWay::alike(const StreamedFrame& frame) const {
  const Pose T = T_last_.inverse() * frame.T_world_camera;
  return T.translation().norm() < options_.on_the_way.new_after_m &&
         Eigen::AngleAxisd(Eigen::Matrix3d(T.linear())).angle() < options_.on_the_way.new_after_rad;
}

double FramesOnTheWay::blur_px(const StreamedFrame& frame) const {
  // Nearer than the distance looked at is a leaf in the way: no reason to look at nothing.
  const double distance_m = std::max(cursor_.seen_distance_m, options_.on_the_way.sharp_distance_m);
  return options_.on_the_way.exposure_s * image_speed(frame.twist, frame.intrinsics, distance_m);
}

/// In simulated time: frames whose turn comes before `until_s`.
Expected<void> FramesOnTheWay::work_off(double until_s) {
  while (!waiting_.empty()) {
    const double begin_s = std::max(free_s_, waiting_.front().frame.arrived_s);
    if (time_.simulated() && begin_s >= until_s) return {};
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    free_s_ = begin_s;
    if (auto ok = take_in(next); !ok) return ok;
  }
  return {};
}

Expected<void> FramesOnTheWay::take_in(const Waiting& next) {
  const StreamedFrame& streamed = next.frame;
  auto frame = stages_.time("camera", [&] { return streamed.images(); });
  if (!frame) {  // the camera counts it too; at the next view its error would end the run
    ++counts_.unread;
    return {};
  }
  if (options_.mask_robot) self_filter_.mask(*frame, streamed.q, streamed.trolley);
  WorkMeter work;
  auto seen = perception_.take_in(*frame, work, stages_);
  if (!seen) return tl::unexpected(seen.error());
  free_s_ += work.seconds(options_.costs);
  time_.aside(work);
  if (const double median_m = median_depth_m(frame->depth); median_m > 0.0) {
    cursor_.seen_distance_m = median_m;
  }
  ++counts_.fused;
  ++untold_;

  FrameOnTheWay event;
  event.twist = streamed.twist;
  FrameEvent& told = event.frame;
  told.segment = cursor_.segment;
  told.view = cursor_.views;
  told.during = during_;
  told.t_s = frame->time_s;
  told.T_world_camera = frame->T_world_camera;
  told.blur_px = next.blur_px;
  told.realised_gain = seen->fused.newly_known;
  told.fused_points = seen->fused.fused_points;
  if (const auto& pixels = seen->pixels) {
    told.pixels =
        PixelHits{pixels->true_positives, pixels->false_positives, pixels->false_negatives};
  }
  for (const auto& fruit : perception_.fruits().fruits()) {
    told.fruits.push_back({fruit.id, fruit.centre, fruit.volume_cm3, fruit.confidence});
  }
  event.images = std::make_shared<const RgbdFrame>(std::move(*frame));
  event.detection = std::make_shared<const Detection>(std::move(seen->detection));
  return events_.emit(std::move(event));
}

/// What the frames since the last time changed. Where nobody plans the map's changes wait for the
/// next view: only its frame says which targets are left.
Expected<void> FramesOnTheWay::tell() {
  if (std::exchange(untold_, 0) == 0) return {};
  const double now_s = time_.now_s();
  free_s_ = std::max(free_s_, now_s);
  const int view = cursor_.views - 1;
  if (during_ != "trolley" && planning_.snapshot) {
    WorkMeter work;
    MapChange change = perception_.settle(planning_.region_world, work, stages_);
    free_s_ += work.seconds(options_.costs);
    time_.aside(work);
    MapChanged told{now_s, view, change.blocks, nullptr, nullptr};
    if (events_.needs().map) {
      told.targets = std::make_shared<const FrontierTargets>(change.targets);
      told.map = std::make_shared<const VoxelMap>(perception_.map());
    }
    if (auto ok = events_.emit(std::move(told)); !ok) return ok;
    change.snapshot = planning_.snapshot();
    stages_.time("planner: new map", [&] {
      time_.background().beside([&](Planner& planner) { planner.map_changed(std::move(change)); });
    });
  }
  return events_.emit(FruitsFound{now_s, view, perception_.fruits().fruits()});
}

}  // namespace canopeer
