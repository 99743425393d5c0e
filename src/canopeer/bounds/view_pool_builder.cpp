#include "canopeer/bounds/view_pool_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/exact_text.h"
#include "canopeer/bounds/visibility/fruit_cutting.h"
#include "canopeer/bounds/visibility/pool_checkpoint.h"
#include "canopeer/bounds/visibility/pool_thinning.h"
#include "canopeer/bounds/visibility/segment_sampler.h"

namespace canopeer {
namespace {

PoolProgress progress_of(const PoolState& state, int segments, const PoolOptions& options) {
  PoolProgress progress;
  progress.segments = segments;
  progress.segment = static_cast<int>(state.pool.segments.size());
  progress.course = state.course;
  const double within = static_cast<double>(state.batches) * options.batch / options.most;
  progress.share = (progress.segment + std::min(1.0, within)) / segments;
  return progress;
}

/// The segment's views are thinned out and become part of the pool.
void finish_segment(PoolState& state, const RobotModel& robot, const PoolOptions& options) {
  ViewPool& pool = state.pool;
  const auto kept = views_to_keep(state.views, pool.patches, robot.endless(), options.near_rad,
                                  static_cast<std::size_t>(options.keep));
  std::vector<PoolView> views;
  views.reserve(kept.size());
  for (const std::size_t i : kept) views.push_back(std::move(state.views[i]));
  pool.segments.push_back(std::move(views));
  pool.sampled += state.course.sampled;
  for (std::size_t p = 0; p < state.times_seen.size(); ++p) {
    pool.times_seen[p] += state.times_seen[p];
  }
  state.views.clear();
  state.times_seen.assign(pool.patches.fruit.size(), 0);
  state.batches = 0;
  state.course = {};
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
  if (aimed < 0 || batch < 1 || most < 1 || keep < 1) {
    return fail("batch, most and keep: 1 or more; aimed: 0 or more");
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
  key += " " + std::to_string(k.width) + "x" + std::to_string(k.height) + " options";
  for (const double x : {o.patch_m, o.seen_once, o.near_rad}) key += " " + exact_text(x);
  for (const int n : {o.aimed, o.batch, o.most, o.keep}) key += " " + std::to_string(n);
  key += " seed " + std::to_string(o.seed) + " segments";
  for (const SegmentPlan& s : mission.segments) {
    key += " " + exact_text(s.trolley.travel_m) + "/" + exact_text(s.trolley.lift_m) + "/" +
           std::to_string(s.side);
  }
  return key;
}

Expected<ViewPool> build_view_pool(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                                   const MotionJudge& judge, const MissionOptions& mission,
                                   const CameraIntrinsics& camera, const PoolOptions& options,
                                   const PoolCallbacks& callbacks) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  const CutFruits fruits = cut_fruits(scene, options.patch_m);
  const std::string key = pool_key(mission, camera, options);
  PoolState state = checkpoint_or_start(options.checkpoint, key, fruits.patches);
  const int segments = static_cast<int>(mission.segments.size());
  const CameraIntrinsics small = pool_camera(mission, camera, options.image_width);
  while (static_cast<int>(state.pool.segments.size()) < segments) {
    const int index = static_cast<int>(state.pool.segments.size());
    const SegmentFrame frame =
        planned_frame(robot, mission.segments[static_cast<std::size_t>(index)], index);
    const SegmentSampler sampler({robot, ik, scene, judge}, frame, fruits, small, options.seed);
    if (state.views.empty()) sampler.look_from_home(state);
    for (bool enough = false; !enough;) {
      sampler.sample(options.batch, state);
      enough = sampled_enough(state, sampler, options);
      PoolProgress progress = progress_of(state, segments, options);
      progress.segment_done = enough;
      if (callbacks.progress) callbacks.progress(progress);
      const bool stop = callbacks.stop && callbacks.stop();
      if (enough) finish_segment(state, robot, options);
      if (!options.checkpoint.empty() && (enough || stop)) {
        if (auto ok = write_checkpoint(options.checkpoint, state); !ok) {
          return tl::unexpected(ok.error());
        }
      }
      if (stop && static_cast<int>(state.pool.segments.size()) < segments) {
        return fail("stopped while views were sampled; the same call goes on");
      }
    }
  }
  if (!options.checkpoint.empty()) {
    std::error_code ignored;
    std::filesystem::remove(options.checkpoint, ignored);
  }
  return std::move(state.pool);
}

}  // namespace canopeer
