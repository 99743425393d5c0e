#include "canopeer/bounds/view_pool_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "canopeer/base/exact_text.h"
#include "canopeer/bounds/visibility/fruit_cutting.h"
#include "canopeer/bounds/visibility/pool_checkpoint.h"
#include "canopeer/bounds/visibility/pool_thinning.h"
#include "canopeer/bounds/visibility/segment_sampler.h"

namespace canopeer {
namespace {

constexpr int kSampling = 2;         // its way; another one makes other pools of the same options
constexpr double kFirstShare = 0.9;  // of the work, a guess: before segments are gone through again
// Tries at rarely seen patches, for each view of the first round, when a segment is gone through
// again.
constexpr std::int64_t kTriesAView = 32;

PoolProgress progress_of(const PoolState& state, int segments, const PoolOptions& options) {
  PoolProgress progress;
  progress.segments = segments;
  progress.segment = static_cast<int>(state.pool.segments.size());
  progress.course = state.course;
  const double within = static_cast<double>(state.batches) * options.batch / options.most;
  progress.share = kFirstShare * (progress.segment + std::min(1.0, within)) / segments;
  return progress;
}

/// The views of a segment that is under way, thinned out; what they have shown counts in the pool.
std::vector<PoolView> finished(PoolState& state, const RobotModel& robot,
                               const PoolOptions& options) {
  ViewPool& pool = state.pool;
  const auto kept = views_to_keep(state.views, pool.patches, robot.endless(), options.near_rad,
                                  static_cast<std::size_t>(options.keep));
  std::vector<PoolView> views;
  views.reserve(kept.size());
  for (const std::size_t i : kept) views.push_back(std::move(state.views[i]));
  pool.sampled += state.course.sampled;
  for (std::size_t p = 0; p < state.times_seen.size(); ++p) {
    pool.times_seen[p] += state.times_seen[p];
  }
  state.views.clear();
  state.times_seen.assign(pool.patches.fruit.size(), 0);
  state.batches = 0;
  state.course = {};
  return views;
}

/// Of the patches that the pool shows those that one view only does.
double seen_once_share(const ViewPool& pool) {
  const auto seen = [&](auto often) {
    return static_cast<double>(
        std::count_if(pool.times_seen.begin(), pool.times_seen.end(), often));
  };
  const double all = seen([](std::uint32_t n) { return n > 0; });
  return all > 0.0 ? seen([](std::uint32_t n) { return n == 1; }) / all : 0.0;
}

std::vector<std::uint32_t> all_patches(const ViewPool& pool) {
  std::vector<std::uint32_t> patches(pool.patches.fruit.size());
  std::iota(patches.begin(), patches.end(), std::uint32_t{0});
  return patches;
}

bool sampled_enough(const PoolState& state, const SegmentSampler& sampler,
                    const PoolOptions& options) {
  const int samples = state.batches * options.batch;
  if (samples >= options.most) return true;
  if (samples < sampler.least_samples(options.aimed)) return false;
  return state.course.seen_once <= options.seen_once * state.course.patches;
}

}  // namespace

Expected<void> PoolOptions::validate() const {
  if (image_width < 16 || image_width > 4096) return fail("image width: 16 … 4096 pixels");
  if (!(patch_m >= 0.001 && patch_m <= 0.1)) return fail("patch_m: 0.001 … 0.1 m");
  if (aimed < 0 || again < 0 || batch < 1 || most < 1 || keep < 1) {
    return fail("batch, most and keep: 1 or more; aimed and again: 0 or more");
  }
  if (!(seen_once >= 0.0 && seen_once <= 1.0)) return fail("seen_once: 0 … 1");
  if (!(near_rad >= 0.0)) return fail("near_rad: 0 or more");
  return {};
}

CameraIntrinsics pool_camera(const MissionOptions& mission, const CameraIntrinsics& camera,
                             int image_width) {
  const double scale = static_cast<double>(image_width) / camera.width;
  CameraIntrinsics small = camera;
  small.width = image_width;
  small.height = std::max(1, static_cast<int>(std::lround(camera.height * scale)));
  small.fx *= scale;
  small.fy *= scale;
  small.cx *= scale;
  small.cy *= scale;
  small.max_range_m = std::min(camera.max_range_m, mission.fruit.tsdf.max_range_m);
  return small;
}

std::string pool_key(const MissionOptions& mission, const CameraIntrinsics& camera,
                     const PoolOptions& o) {
  const CameraIntrinsics k = pool_camera(mission, camera, o.image_width);
  std::string key = "world " + std::to_string(o.world) + " camera";
  for (const double x : {k.fx, k.fy, k.cx, k.cy, k.min_range_m, k.max_range_m}) {
    key += " " + exact_text(x);
  }
  key += " " + std::to_string(k.width) + "x" + std::to_string(k.height) + " sampling " +
         std::to_string(kSampling) + " options";
  for (const double x : {o.patch_m, o.seen_once, o.near_rad}) key += " " + exact_text(x);
  for (const int n : {o.aimed, o.batch, o.most, o.again, o.keep}) key += " " + std::to_string(n);
  key += " seed " + std::to_string(o.seed) + " segments";
  for (const SegmentPlan& s : mission.segments) {
    key += " " + exact_text(s.trolley.travel_m) + "/" + exact_text(s.trolley.lift_m) + "/" +
           std::to_string(s.side);
  }
  return key;
}

namespace {

/// A pool under way, with all that it is made of.
class PoolBuilder {
 public:
  PoolBuilder(const SampledWorld& world, const MissionOptions& mission,
              const CameraIntrinsics& camera, const PoolOptions& options,
              const PoolCallbacks& callbacks)
      : world_(world),
        mission_(mission),
        camera_(pool_camera(mission, camera, options.image_width)),
        options_(options),
        callbacks_(callbacks),
        fruits_(cut_fruits(world.scene, options.patch_m)),
        state_(checkpoint_or_start(options.checkpoint, pool_key(mission, camera, options),
                                   fruits_.patches)) {}

  Expected<ViewPool> build() {
    while (state_.pool.segments.size() < mission_.segments.size()) {
      if (auto ok = sample_next_segment(); !ok) return tl::unexpected(ok.error());
    }
    const int most = options_.again * segments();
    while (state_.again < most && seen_once_share(state_.pool) > options_.seen_once) {
      if (auto ok = go_again_through_a_segment(); !ok) return tl::unexpected(ok.error());
    }
    if (!options_.checkpoint.empty()) {
      std::error_code ignored;
      std::filesystem::remove(options_.checkpoint, ignored);
    }
    return std::move(state_.pool);
  }

 private:
  [[nodiscard]] int segments() const { return static_cast<int>(mission_.segments.size()); }

  [[nodiscard]] SegmentSampler sampler(int segment) const {
    const SegmentPlan& plan = mission_.segments[static_cast<std::size_t>(segment)];
    return {world_, planned_frame(world_.robot, plan, segment), fruits_, camera_, options_.seed};
  }

  Expected<void> sample_next_segment() {
    const SegmentSampler sampler = this->sampler(static_cast<int>(state_.pool.segments.size()));
    if (state_.views.empty()) sampler.look_from_home(state_);
    for (bool enough = false; !enough;) {
      sampler.sample(options_.batch, state_);
      enough = sampled_enough(state_, sampler, options_);
      PoolProgress progress = progress_of(state_, segments(), options_);
      progress.segment_done = enough;
      if (callbacks_.progress) callbacks_.progress(progress);
      const bool stop = asked_to_stop();
      if (enough) state_.pool.segments.push_back(finished(state_, world_.robot, options_));
      if (auto ok = keep(enough, stop); !ok) return ok;
    }
    return {};
  }

  Expected<void> go_again_through_a_segment() {
    const int segment = state_.again % segments();
    const SegmentSampler sampler = this->sampler(segment);
    auto& views = state_.pool.segments[static_cast<std::size_t>(segment)];
    state_.views = std::move(views);
    state_.course.segment = segment;
    sampler.aim_again(rarely_seen(all_patches(state_.pool), state_.pool.times_seen),
                      kTriesAView * options_.most, state_.again / segments(), state_);
    views = finished(state_, world_.robot, options_);
    ++state_.again;
    if (callbacks_.progress) callbacks_.progress(progress_again());
    return keep(true, asked_to_stop());
  }

  [[nodiscard]] PoolProgress progress_again() const {
    PoolProgress progress;
    progress.segments = segments();
    progress.segment = segments() - 1;
    progress.again = (state_.again + segments() - 1) / segments();
    const int most = options_.again * segments();
    progress.share = kFirstShare + (1.0 - kFirstShare) * state_.again / most;
    progress.segment_done = state_.again % segments() == 0;
    progress.course.sampled = state_.pool.sampled;
    for (const std::uint32_t times : state_.pool.times_seen) {
      progress.course.patches += times > 0 ? 1 : 0;
      progress.course.seen_once += times == 1 ? 1 : 0;
    }
    progress.course.fruits = fruits_seen(state_.pool.patches, state_.pool.times_seen);
    return progress;
  }

  [[nodiscard]] bool asked_to_stop() const { return callbacks_.stop && callbacks_.stop(); }

  /// What there is, in the checkpoint; then stops if that was asked for.
  Expected<void> keep(bool segment_done, bool stop) {
    if (!options_.checkpoint.empty() && (segment_done || stop)) {
      if (auto ok = write_checkpoint(options_.checkpoint, state_); !ok) return ok;
    }
    if (stop) return fail("stopped while views were sampled; the same call goes on");
    return {};
  }

  SampledWorld world_;
  const MissionOptions& mission_;
  CameraIntrinsics camera_;
  const PoolOptions& options_;
  const PoolCallbacks& callbacks_;
  CutFruits fruits_;
  PoolState state_;
};

}  // namespace

Expected<ViewPool> build_view_pool(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                                   const MotionJudge& judge, const MissionOptions& mission,
                                   const CameraIntrinsics& camera, const PoolOptions& options,
                                   const PoolCallbacks& callbacks) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  return PoolBuilder({robot, ik, scene, judge}, mission, camera, options, callbacks).build();
}

}  // namespace canopeer
