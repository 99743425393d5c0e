#include "canopeer/ros2/arm/ros2_arm.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr double kArmStill = 0.002;                     // rad (m): noise of joint states is less
constexpr double kArmStill_s = 0.1;                     // so long
constexpr std::chrono::milliseconds kStandstill(2000);  // then it counts as one all the same
constexpr std::chrono::milliseconds kStandstillStep(10);

double turned_by(double from, double to, bool endless) {
  const double delta = to - from;
  return endless ? std::remainder(delta, 6.283185307179586) : delta;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

Ros2Arm::Ros2Arm(Parts parts, const Ros2Settings& settings,
                 std::unique_ptr<TrajectoryClient> client, std::unique_ptr<SafetyMode> safety)
    : parts_(std::move(parts)),
      settings_(settings.arm),
      dry_run_(settings.dry_run),
      client_(std::move(client)),
      safety_(std::move(safety)) {
  for (const std::string& joint : parts_.robot.setup().arm_joints) {
    names_.push_back(drivers_name(settings_.joint_names, joint));
  }
}

Expected<std::unique_ptr<Ros2Arm>> Ros2Arm::make(Parts parts, const Ros2Settings& settings) {
  auto client = TrajectoryClient::make(parts.node, settings.arm.action);
  if (!client) return tl::unexpected(client.error());
  std::unique_ptr<SafetyMode> safety;
  if (!settings.arm.safety_mode.empty()) {
    auto made = SafetyMode::make(parts.node, settings.arm.safety_mode);
    if (!made) return tl::unexpected(made.error());
    safety = std::move(*made);
  }
  return std::unique_ptr<Ros2Arm>(
      new Ros2Arm(std::move(parts), settings, std::move(*client), std::move(safety)));
}

/// By the driver's own count of turns.
Configuration Ros2Arm::drivers_positions() const {
  const auto last = parts_.joints.last();
  if (!last) return Configuration::Zero(parts_.robot.dof());
  return Eigen::Map<const Eigen::VectorXd>(last->data(), parts_.robot.dof());
}

Configuration Ros2Arm::configuration() const {
  Configuration q = drivers_positions();
  const JointLimits& limits = parts_.robot.limits();
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double inside = std::clamp(q[i], limits.lower[i], limits.upper[i]);
    if (std::abs(q[i] - inside) <= settings_.start_tolerance_rad) q[i] = inside;
  }
  return q;
}

Expected<void> Ros2Arm::fresh() const {
  if (auto ok = parts_.clock.check(); !ok) return ok;
  const auto silent = parts_.joints.silent(settings_.max_silence_s);
  if (silent.empty()) {
    const auto wrong = parts_.contradiction ? parts_.contradiction() : std::nullopt;
    if (wrong) return fail("lost the arm: " + *wrong);
    return {};
  }
  return fail("lost the arm: no joint state of " + listed(silent) + " for " +
              figure(settings_.max_silence_s, 1) + " s on " + listed(settings_.joint_states));
}

/// Why a motion must not begin; nothing: it may.
std::optional<MotionOutcome> Ros2Arm::refusal(const JointPath& path) const {
  const auto refused = [](MotionEnd end, std::string why) {
    MotionOutcome outcome;
    outcome.end = end;
    outcome.why = std::move(why);
    return outcome;
  };
  if (safety_ != nullptr) {
    if (auto stop = safety_->stop()) return refused(MotionEnd::stopped, std::move(*stop));
  }
  // Said while the motion was planned: the mission does not know it yet.
  if (parts_.person.arm_stops()) return refused(MotionEnd::cancelled, "the run is to stop");
  if (path.waypoints.empty()) return refused(MotionEnd::refused, "there is no path");
  const Configuration q = configuration();
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double beside = std::abs(
        turned_by(path.waypoints.front()[i], q[i], parts_.robot.endless()[static_cast<int>(i)]));
    if (beside <= settings_.start_tolerance_rad) continue;
    return refused(MotionEnd::refused, names_[static_cast<std::size_t>(i)] + " is " +
                                           figure(beside, 3) +
                                           " from where the motion begins: was the arm moved? See "
                                           "why before you raise ros2.arm.start_tolerance_rad");
  }
  return std::nullopt;
}

/// The first motions are slower by stretching time, as all are (decision 94).
JointLimits Ros2Arm::limits() const {
  JointLimits limits = parts_.robot.limits();
  if (motions_ >= settings_.first_motions) return limits;
  limits.velocity *= settings_.first_motion_scale;
  limits.acceleration *= settings_.first_motion_scale * settings_.first_motion_scale;
  return limits;
}

double Ros2Arm::hold_back(MotionEnd end, std::string why, double duration_s) {
  held_back_.emplace();
  held_back_->end = end;
  held_back_->why = std::move(why);
  duration_s_ = duration_s;
  return duration_s;
}

/// False: it is held back. The error: where the arm is is not known, or it is to stay there.
Expected<bool> Ros2Arm::may_begin(const JointPath& path) {
  if (parts_.person.at_once()) {
    return fail("told to stop twice: the arm stays where it is; bring it home by hand");
  }
  if (auto ok = fresh(); !ok) return tl::unexpected(ok.error());
  held_back_ = refusal(path);
  duration_s_ = 0.0;
  return !held_back_;
}

Expected<double> Ros2Arm::start(const JointPath& path) {
  auto may = may_begin(path);
  if (!may) return tl::unexpected(may.error());
  if (!*may) return 0.0;
  const PathMotion motion(path, parts_.robot, limits());
  if (dry_run_) return hold_back(MotionEnd::withheld, "a dry run", motion.duration_s());
  if (parts_.person.may_move) {
    const std::string what = "move the arm for " + figure(motion.duration_s(), 1) + " s";
    if (!parts_.person.may_move(what) && !parts_.person.arm_stops()) {
      return hold_back(MotionEnd::cancelled, "a person said no");
    }
    may = may_begin(path);  // the answer may have taken minutes
    if (!may) return tl::unexpected(may.error());
    if (!*may) return 0.0;
  }
  goal_ =
      trajectory_goal(motion, names_, drivers_positions(), parts_.robot.endless(),
                      {settings_.rate_hz, settings_.path_tolerance_rad,
                       settings_.goal_tolerance_rad, settings_.goal_time_tolerance_s, limits()});
  const auto accepted = client_->send(goal_);
  if (!accepted) return fail_in("lost " + settings_.action, accepted.error());
  if (!*accepted) {
    return hold_back(MotionEnd::refused,
                     settings_.action + " refuses the trajectory; its log says why");
  }
  ++motions_;
  return duration_s_ = duration_s(goal_);
}

Expected<MotionOutcome> Ros2Arm::finish() {
  if (held_back_) {
    wait_out(duration_s_);
    MotionOutcome outcome = *std::exchange(held_back_, std::nullopt);
    outcome.q = configuration();
    if (auto ok = fresh(); !ok) return tl::unexpected(ok.error());
    return outcome;
  }
  return finish_sent();
}

/// A motion that is not sent takes its time all the same, unless a person stops the run.
void Ros2Arm::wait_out(double duration_s) const {
  const double end_s = parts_.clock.now_s() + duration_s;
  while (parts_.clock.now_s() < end_s && parts_.clock.check()) {
    if (parts_.person.arm_stops()) return;
    parts_.clock.sleep(0.01);
  }
}

std::optional<std::string> Ros2Arm::cancel_reason() const {
  if (safety_ != nullptr) {
    if (auto stop = safety_->stop()) return stop;
  }
  if (parts_.person.at_once()) return "the run is to stop at once";
  if (parts_.person.arm_stops()) return "the run is to stop";
  return std::nullopt;
}

Expected<MotionOutcome> Ros2Arm::finish_sent() {
  const auto sent = parts_.joints.newest();
  GoalWatch watch;
  watch.alive = [this] { return fresh(); };
  watch.cancel = [this] { return cancel_reason(); };
  watch.longest_s = settings_.max_slowdown * duration_s_ + settings_.goal_time_tolerance_s;
  watch.max_feedback_silence_s = 2.0 * settings_.max_silence_s;
  auto ending = client_->finish(watch);
  if (!ending) return tl::unexpected(ending.error());

  MotionReport report;
  report.goal = std::move(*ending);
  report.goal_tolerance = settings_.goal_tolerance_rad;
  const auto still = parts_.joints.still_since(kArmStill);
  const auto newest = parts_.joints.newest();
  if (still && newest && sent) report.stood_still_s = seconds(*newest - std::max(*still, *sent));
  wait_for_standstill();
  if (auto ok = fresh(); !ok) return tl::unexpected(ok.error());
  if (safety_ != nullptr) report.safety_stop = safety_->stop();
  find_farthest(report);
  MotionOutcome outcome = motion_ending(report);
  outcome.q = configuration();
  return outcome;
}

/// Positions are those of after the end, and the arm does not swing any more.
void Ros2Arm::wait_for_standstill() const {
  const auto deadline = JointHistory::Steady::now() + kStandstill;
  const auto heard_at_end = parts_.joints.newest();
  while (JointHistory::Steady::now() < deadline) {
    const auto still = parts_.joints.still_since(kArmStill);
    const auto newest = parts_.joints.newest();
    if (!still || !newest || !fresh()) return;
    if (newest > heard_at_end && *newest - *still >= nanoseconds(kArmStill_s)) return;
    std::this_thread::sleep_for(kStandstillStep);
  }
}

void Ros2Arm::find_farthest(MotionReport& report) const {
  const Configuration end = end_of(goal_);
  const Configuration q = drivers_positions();
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double off =
        std::abs(turned_by(end[i], q[i], parts_.robot.endless()[static_cast<int>(i)]));
    if (i > 0 && off <= report.off_goal) continue;
    report.off_goal = off;
    report.farthest_joint = names_[static_cast<std::size_t>(i)];
  }
}

}  // namespace canopeer::ros
