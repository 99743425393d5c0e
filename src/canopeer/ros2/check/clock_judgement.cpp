#include "canopeer/ros2/check/clock_judgement.h"

#include <cmath>
#include <string>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr double kAhead_s = -0.005;  // of our clock: nothing comes before it was sent
constexpr double kMeasured_s = 0.1;  // small motions tell as much
constexpr double kOld_s = 0.5;       // no way takes that long

std::string age_text(double age_s) {
  if (age_s < 0.0) return figure(-1e3 * age_s, 0) + " ms from the future";
  return figure(1e3 * age_s, 1) + " ms old";
}

}  // namespace

void judge_clocks(std::optional<double> joints_s, std::optional<double> camera_s,
                  double time_offset_s, Findings& findings) {
  const std::string what = "clocks";
  if (!joints_s || !camera_s) return;  // said elsewhere
  const std::string ages = "joint states are " + age_text(*joints_s) +
                           " when they come in, images " + age_text(*camera_s);
  const auto odd = [](double age_s) { return age_s < kAhead_s || age_s > kOld_s; };
  const double camera_behind_s = *camera_s - time_offset_s - *joints_s;
  // Images take some tens of milliseconds; more, or less than none, is the clocks.
  if (camera_behind_s < 2.0 * kAhead_s || camera_behind_s > kOld_s) {
    const std::string off = ages + ": the camera's clock is about " +
                            figure(std::abs(camera_behind_s), 2) + " s " +
                            (camera_behind_s > 0.0 ? "behind" : "ahead of") +
                            " that of the joint states; synchronise them (chrony), or set "
                            "ros2.camera.time_offset_s to " +
                            figure(time_offset_s + camera_behind_s, 2);
    if (std::abs(camera_behind_s) < kMeasured_s) {
      findings.notice(what, off + " at least: --move measures it");
    } else {
      findings.wrong(what, off);
    }
  } else if (odd(*joints_s)) {
    findings.notice(what, ages +
                              ": the robot's clock is not ours; missions go by the robot's, but "
                              "better synchronise them (chrony)");
  } else {
    findings.ok(what, ages);
  }
}

void judge_sim_time(bool use_sim_time, bool clock_published, bool running, Findings& findings) {
  const std::string what = "time";
  if (use_sim_time && !running) {
    findings.wrong(what, clock_published
                             ? "/clock is published, but stands still: is the simulation paused?"
                             : "nobody publishes /clock, which ros2.use_sim_time needs");
  } else if (!use_sim_time && clock_published) {
    findings.notice(what,
                    "the wall's, though /clock is published: of a simulation? Then set "
                    "ros2.use_sim_time to true");
  } else {
    findings.ok(what, use_sim_time ? "that of /clock" : "the wall's");
  }
}

}  // namespace canopeer::ros
