#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <future>
#include <optional>

#include "canopeer/map/cloud_fusion.h"
#include "canopeer/map/map_file.h"
#include "commands.h"
#include "exit_status.h"
#include "map_summary.h"
#include "progress_bar.h"
#include "recording.h"
#include "recording_check.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

void report_gaps(const MapFuseArguments& arguments, const Recording& recording) {
  const PoseGaps gaps = recording.gaps();
  if (gaps.observations == 0) return;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "%d of %zu frames have no pose: they lie outside the trajectory or in a gap of more "
      "than %g s (the first at %.6f s)",
      gaps.observations, recording.size() + static_cast<std::size_t>(gaps.observations),
      arguments.max_pose_gap_s, gaps.first_s);
  if (arguments.strict) stop_with(kBadInput, {arguments.dataset + ": " + text});
  if (!arguments.quiet) std::fprintf(stderr, "canopeer: passed over: %s\n", text);
}

/// Loads the observations ahead of the one that is asked for, while that is being fused.
class ReadAhead {
 public:
  ReadAhead(const Recording& recording, std::size_t step, bool ahead)
      : recording_(recording), step_(step), ahead_(ahead) {}

  Expected<Observation> load(std::size_t i) {
    auto observation = next_.valid() ? next_.get() : recording_.load(i);
    if (ahead_ && i + step_ < recording_.size()) {
      next_ = std::async(std::launch::async, [this, i] { return recording_.load(i + step_); });
    }
    return observation;
  }

 private:
  const Recording& recording_;
  std::size_t step_;
  bool ahead_;
  std::future<Expected<Observation>> next_;
};

struct Fused {
  int frames = 0;
  std::int64_t points = 0;
  std::int64_t absurd = 0;  // points of clouds that no sensor measures
};

std::int64_t absurd_points(const Observation& observation) {
  const auto* cloud = std::get_if<PosedCloud>(&observation);
  if (cloud == nullptr) return 0;
  const auto& points = cloud->file.cloud.points;
  return std::count_if(points.begin(), points.end(), [](const Eigen::Vector3f& p) {
    return p.allFinite() && p.cast<double>().norm() >= kNoReturn_m;
  });
}

Fused fuse_all(const MapFuseArguments& arguments, const Recording& recording, VoxelMap& map,
               const std::atomic<bool>& stop) {
  const auto step = static_cast<std::size_t>(arguments.every);
  const std::size_t frames = (recording.size() + step - 1) / step;
  ReadAhead reader(recording, step, arguments.threads != 1);
  FusionOptions fusion;
  fusion.max_range_m = arguments.max_range_m;
  fusion.clear_no_return = arguments.clear_no_return;
  ProgressBar bar(arguments.quiet);
  Fused fused;
  for (std::size_t i = 0; i < recording.size() && !stop; i += step) {
    const Observation observation = value_or_stop(reader.load(i), kBadInput);
    const auto points = fuse_observation(map, observation, fusion);
    if (!points) stop_with(kBadInput, {recording.name(i) + ": " + points.error().message});
    fused.points += *points;
    fused.absurd += absurd_points(observation);
    ++fused.frames;
    char text[120];
    std::snprintf(text, sizeof text, "frame %d/%zu  %lld points  %lld known voxels", fused.frames,
                  frames, static_cast<long long>(fused.points),
                  static_cast<long long>(map.observed_voxels()));
    const double fraction = static_cast<double>(fused.frames) / static_cast<double>(frames);
    bar.show(fraction, text, static_cast<int>(fraction * 9.999));
  }
  bar.finish();
  return fused;
}

}  // namespace

void map_fuse(const MapFuseArguments& arguments) {
  value_or_stop(check_map_destination(arguments.out), kBadInput);
  std::optional<tbb::global_control> threads;
  if (arguments.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(arguments.threads));
  }
  const auto recording = value_or_stop(open_recording(arguments), kBadInput);
  const std::atomic<bool>& stop = catch_stop_signals();
  report_gaps(arguments, *recording);
  for (const std::string& notice : value_or_stop(check_recording(*recording), kBadInput)) {
    if (!arguments.quiet) std::fprintf(stderr, "canopeer: notice: %s\n", notice.c_str());
  }
  VoxelMapOptions options;
  options.resolution_m = arguments.resolution_m;
  VoxelMap map(options);

  const Fused fused = fuse_all(arguments, *recording, map, stop);
  const auto files = value_or_stop(write_map(map, arguments.out), kFailed);
  if (!arguments.quiet) {
    std::printf("frames            %d, %lld points\n", fused.frames,
                static_cast<long long>(fused.points));
    if (!recording->poses().taken.empty()) {
      std::printf("poses             %s\n", recording->poses().taken.c_str());
    }
    print_map(map);
    for (const auto& file : files) std::printf("%s\n", file.c_str());
  }
  if (fused.absurd > 0 && !arguments.quiet) {
    std::fprintf(stderr, "canopeer: notice: left out: %lld points beyond %g m\n",
                 static_cast<long long>(fused.absurd), kNoReturn_m);
  }
  if (!stop && map.observed_voxels() == 0) {
    std::fprintf(stderr,
                 "canopeer: warning: %s is empty: none of the %d frames of %s has a pixel or point "
                 "with a finite distance\n",
                 arguments.out.c_str(), fused.frames, arguments.dataset.c_str());
  } else if (!stop && fused.points == 0) {
    std::fprintf(
        stderr,
        "canopeer: warning: %s holds free space only: none of the %d frames of %s has a "
        "pixel or point within %g m; is the unit right? (see --depth-factor, --max-range)\n",
        arguments.out.c_str(), fused.frames, arguments.dataset.c_str(), arguments.max_range_m);
  }
  if (stop) {
    std::fprintf(stderr, "canopeer: interrupted; %s holds the first %d frames\n",
                 arguments.out.c_str(), fused.frames);
    throw Stop{kInterrupted};
  }
}

}  // namespace canopeer::app
