#include <sys/resource.h>

#include <atomic>
#include <cstdio>
#include <memory>
#include <string>

#include "canopeer/record/yardstick.h"
#include "canopeer/run/run.h"
#include "commands.h"
#include "exit_status.h"
#include "import_line.h"
#include "live_view.h"
#include "mission_arguments.h"
#include "mission_progress.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

constexpr const char* kRos2 = "ros2";

Overrides overrides_of(const RunArguments& arguments) {
  Overrides o;
  if (!arguments.planner.empty()) o.emplace_back("planner", arguments.planner);
  if (!arguments.protocol.empty()) o.emplace_back("protocol", arguments.protocol);
  if (arguments.segments) o.emplace_back("max_segments", std::to_string(*arguments.segments));
  if (arguments.time_per_segment_s) {
    o.emplace_back("time_per_segment_s", std::to_string(*arguments.time_per_segment_s));
  }
  if (!arguments.compute_table.empty()) o.emplace_back("compute_table", arguments.compute_table);
  if (arguments.dry_run) o.emplace_back("ros2.dry_run", "true");
  if (arguments.confirm) o.emplace_back("ros2.confirm", "true");
  return o;
}

/// A dry run of a simulation would be none, and a program without ROS 2 knows no such site.
void check_site(const RunArguments& arguments) {
  if (arguments.site != kRos2 && (arguments.dry_run || arguments.confirm)) {
    stop_with(kBadInput, {"--dry-run and --confirm are for a robot: --site ros2"});
  }
  const auto& sites = arguments.mission.registries->sites;
  if (arguments.site == kRos2 && sites.one_line(kRos2).empty()) {
    stop_with(kBadInput, {"ROS 2 is not in this build: " + std::string(kWholeBuild)});
  }
}

std::unique_ptr<Run> compose(const RunArguments& arguments, const std::atomic<bool>& page_stop) {
  check_site(arguments);
  ImportLine line(arguments.quiet);
  const Overrides overrides = overrides_of(arguments);
  StageRequest request = stage_request(arguments.mission, overrides);
  request.site = arguments.site;
  request.realtime = arguments.realtime;
  request.threads = arguments.threads;
  request.callbacks = callbacks_for_people(line, arguments.quiet);
  request.callbacks.on_message = [](const std::string& text) {
    std::fprintf(stderr, "canopeer: %s\n", text.c_str());
  };
  request.callbacks.stop_asked = [&page_stop, &stop = catch_stop_signals()] {
    return stop || page_stop;
  };
  if (arguments.site == kRos2) {
    request.callbacks.stop_at_once = [&stop = catch_second_stop()] { return stop.load(); };
  }
  return value_or_stop(Run::compose(load(arguments.mission, overrides), request,
                                    *arguments.mission.registries, arguments.out),
                       kBadInput);
}

/// A yardstick that does not fit is said before hours are spent.
void hold_against(const std::filesystem::path& file, Run& run) {
  auto yardstick = value_or_stop(read_yardstick(file), kBadInput);
  if (auto ok = run.hold_against(std::move(yardstick)); !ok) {
    stop_with(kBadInput, {file.string() + ": " + ok.error().message});
  }
}

/// Of what could be found, where a yardstick says what that is.
void print_shares(const Summary& s) {
  std::string line;
  const auto add = [&](const std::optional<double>& share, const char* what) {
    if (!share) return;
    char text[96];
    std::snprintf(text, sizeof text, "%s%.1f %% %s", line.empty() ? "" : ", ", 100.0 * *share,
                  what);
    line += text;
  };
  add(s.ceiling_fruits_share, "of those that can be seen");
  add(s.clairvoyant_found_share, "of the clairvoyant's");
  add(s.best_found_share, "of the most known");
  if (!line.empty()) std::printf("that is           %s\n", line.c_str());
}

/// What became of frames on the way, where they were wanted.
void print_frames(const Summary& s) {
  if (!s.frames_fused) return;
  std::printf("on the way        %d frames taken in, %d late, %d blurred, %d alike",
              *s.frames_fused, s.frames_late.value_or(0), s.frames_blurred.value_or(0),
              s.frames_alike.value_or(0));
  if (s.frames_unread.value_or(0) > 0) std::printf(", %d unread", *s.frames_unread);
  std::printf("\n");
}

/// The figures people ask for first.
void print_summary(const Summary& s, const std::filesystem::path& out) {
  if (s.fruits_total) {
    std::printf("fruits found      %d of %d within 5 cm (%d as the paper counts), %d false\n",
                s.detected.value_or(0), *s.fruits_total, s.detected_paper.value_or(0),
                s.false_positives.value_or(0));
  } else {
    std::printf("fruits found      %d\n", s.fruits_reported);
  }
  print_shares(s);
  std::printf("views             %d in %.0f s of mission time (%.1f s of wall time)\n", s.views,
              s.sim_time_s, s.wall_time_s);
  print_frames(s);
  std::printf(
      "collisions        %d, motions that touched unseen leaves %d\n"
      "report            %s\n",
      s.collisions, s.plant_contacts, (out / "report.html").c_str());
}

void print_profile(const StageTimer& timer, double wall_s) {
  std::printf("\n%-18s %9s\n", "stage", "wall s");
  for (const auto& [stage, seconds] : timer.seconds()) {
    std::printf("%-18s %9.2f\n", stage.c_str(), seconds);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%-18s %9.2f\npeak memory        %9.0f MB\n", "all", wall_s,
              static_cast<double>(usage.ru_maxrss) / 1024.0);
}

/// Watchers lose nothing of the run, but people should know.
void print_lost_watchers(const Mission& mission) {
  for (const auto& w : mission.watched()) {
    if (!w.failure.empty()) {
      std::fprintf(stderr, "canopeer: notice: %s failed: %s\n", w.name.c_str(), w.failure.c_str());
    } else if (w.left_behind) {
      std::fprintf(stderr, "canopeer: notice: %s did not come to an end\n", w.name.c_str());
    } else if (w.lost > 0) {
      std::fprintf(stderr, "canopeer: notice: %s was too slow for %lld events\n", w.name.c_str(),
                   static_cast<long long>(w.lost));
    }
  }
}

}  // namespace

void run(const RunArguments& arguments) {
  SignalSteering signals;
  std::atomic<bool> page_stop{false};
  const std::unique_ptr<Run> run = compose(arguments, page_stop);
  if (!arguments.yardstick.empty()) hold_against(arguments.yardstick, *run);
  SteeringTogether steering;
  steering.add(signals);
  const LiveView view(*run, steering, page_stop, arguments.view);
  run->steer(steering);
  run->watch(std::make_shared<MissionProgress>(arguments.quiet), {.name = "the progress bar"});
  value_or_stop(run->begin(), kFailed);
  while (run->step()) {
  }
  const auto summary = run->finish();
  print_lost_watchers(run->mission());
  if (summary && !arguments.quiet) print_summary(*summary, run->out());
  if (summary && arguments.profile) print_profile(run->mission().timer(), summary->wall_time_s);
  std::fflush(stdout);
  view.stay(arguments.quiet);
  // What ended the run is said first: why results cannot be written may follow from it.
  if (!run->outcome() && !summary) {
    stop_with(kFailed, {run->outcome().error().message + "; then " + summary.error().message});
  }
  if (!run->outcome()) stop_with(kFailed, run->outcome().error());
  value_or_stop(summary, kFailed);
  if (run->interrupted()) {
    std::fprintf(stderr, "canopeer: interrupted; the results so far are in %s\n",
                 run->out().c_str());
    throw Stop{kInterrupted};
  }
}

}  // namespace canopeer::app
