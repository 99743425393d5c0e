#include "canopeer/mission/segment/arm_mover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "canopeer/robot/corner_rounding.h"

namespace canopeer {
namespace {

constexpr int kMostMissed = 3;  // motions in a row that do not arrive

/// The waypoints before the place of the way that is nearest to `q`, and `q`.
std::vector<Configuration> way_to(const Configuration& q,
                                  const std::vector<Configuration>& waypoints) {
  std::size_t piece = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Configuration line = waypoints[i + 1] - waypoints[i];
    const double length2 = std::max(line.squaredNorm(), 1e-12);
    const double s = std::clamp((q - waypoints[i]).dot(line) / length2, 0.0, 1.0);
    const double distance = (q - waypoints[i] - s * line).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    piece = i;
  }
  std::vector<Configuration> way(waypoints.begin(),
                                 waypoints.begin() + static_cast<std::ptrdiff_t>(piece) + 1);
  way.push_back(q);
  return way;
}

/// How far the camera moves, m, while the arm goes straight from point to point.
double camera_path_m(const RobotModel& robot, const std::vector<Configuration>& points) {
  constexpr double kStep = 0.05;  // rad, Σ|Δq| between two places on the way
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const int steps = 1 + static_cast<int>(joint_distance(points[i - 1], points[i]) / kStep);
    Vec3 at = robot.T_base_camera(points[i - 1]).translation();
    for (int k = 1; k <= steps; ++k) {
      const Configuration q = points[i - 1] + (points[i] - points[i - 1]) * k / steps;
      const Vec3 next = robot.T_base_camera(q).translation();
      length_m += (next - at).norm();
      at = next;
    }
  }
  return length_m;
}

}  // namespace

ArmMover::ArmMover(const RobotModel& robot, const Ports& ports, Traveller& traveller,
                   Timekeeper& time, FramesOnTheWay& frames, EventHub& events,
                   MissionCursor& cursor, const std::optional<ImageMotionLimit>& sharp)
    : robot_(robot),
      ports_(ports),
      traveller_(traveller),
      time_(time),
      frames_(frames),
      events_(events),
      cursor_(cursor),
      sharp_(sharp) {}

Expected<MotionEnd> ArmMover::move(const std::string& kind,
                                   const std::vector<Configuration>& waypoints,
                                   const CollisionChecker& checker) {
  // Who goes home is in a hurry: what is sharp on the way is so by itself.
  const auto sharp = kind == "view" ? sharp_ : std::nullopt;
  const JointPath path = without_needless_stops({waypoints, {}, sharp}, checker);
  MotionEvent motion;
  motion.kind = kind;
  motion.segment = cursor_.segment;
  motion.start_s = time_.now_s();
  for (const auto& q : waypoints) motion.waypoints.emplace_back(q.data(), q.data() + q.size());
  motion.deviations = path.deviations;
  const std::vector<Configuration> points = points_along(path);
  for (std::size_t i = 1; i < points.size(); ++i) {
    motion.joint_path_rad += joint_distance(points[i - 1], points[i]);
  }
  motion.camera_path_m = camera_path_m(robot_, points);
  const auto duration = time_.timer().time("arm", [&] { return ports_.arm->start(path); });
  if (!duration) return fail_in("arm", duration.error());

  auto told = events_.emit(MotionBegun{kind, motion.segment, motion.start_s, *duration, path});
  auto looked = frames_.set_out(kind);
  if (looked) looked = frames_.go_along(*duration);
  const auto outcome = time_.timer().time("arm", [&] { return ports_.arm->finish(); });
  const double arrived_s = time_.now_s();
  const auto frames = frames_.arrive();
  if (!outcome) return fail_in("arm", outcome.error());
  if (!looked) return tl::unexpected(looked.error());
  if (!frames) return tl::unexpected(frames.error());
  motion.frames = *frames;
  const bool arrived = outcome->end == MotionEnd::arrived;
  traveller_.took(arrived ? waypoints : way_to(outcome->q, waypoints));
  if (!arrived) motion.ended = motion_end_name(outcome->end);
  motion.why = outcome->why;
  motion.duration_s = arrived_s - motion.start_s;
  motion.collision = outcome->collision;
  motion.plant_contact = outcome->plant_contact;
  cursor_.last_standing_s = motion.start_s - cursor_.standing_since_s;
  cursor_.last_motion_s = motion.duration_s;
  cursor_.standing_since_s = arrived_s;
  if (told) told = events_.emit(MotionEnded{std::move(motion)});
  if (told) told = mind(*outcome);
  if (!told) return tl::unexpected(told.error());
  return outcome->end;
}

/// Remembers what did not arrive: the run goes on as long as it seems to be of use.
Expected<void> ArmMover::mind(const MotionOutcome& outcome) {
  if (outcome.end == MotionEnd::withheld) return {};
  if (outcome.end == MotionEnd::arrived) {
    cursor_.missed_motions = 0;
    return {};
  }
  const std::string what =
      std::string(motion_end_name(outcome.end)) + (outcome.why.empty() ? "" : ": " + outcome.why);
  if (outcome.end == MotionEnd::stopped || outcome.end == MotionEnd::preempted) {
    cursor_.needs_person = what;
  }
  if (++cursor_.missed_motions < kMostMissed) return {};
  return fail("arm: " + std::to_string(kMostMissed) +
              " motions in a row did not arrive; the last " + what);
}

JointPath ArmMover::without_needless_stops(const JointPath& stopping,
                                           const CollisionChecker& checker) {
  if (stopping.waypoints.size() < 3) return stopping;
  int states = 0;
  JointPath path =
      time_.timer().time("arm", [&] { return round_corners(stopping, robot_, checker, states); });
  WorkMeter work;
  work.add(Work::motion_plan, states);
  time_.pay(work);
  return path;
}

Expected<MotionEnd> ArmMover::go_home(const Configuration& home, const CollisionChecker& checker) {
  WorkMeter work;
  const auto way = time_.timer().time(
      "way home", [&] { return traveller_.way_home(where(), home, checker, work); });
  time_.pay(work);
  if (way.size() > 1) {
    const auto end = move("home", way, checker);
    if (!end || *end != MotionEnd::arrived) return end;
  }
  if (robot_.endless().distance(way.back(), home) > 1e-9) {
    return fail("segment " + std::to_string(cursor_.segment) +
                ": no collision-free way home was found; is the home state of the next segment "
                "blocked by plants?");
  }
  traveller_.forget_way(where());
  return MotionEnd::arrived;
}

Expected<void> ArmMover::drive(const Trolley::Drive& drive) {
  const TrolleyState from = ports_.trolley->state();
  if (drive.goal.travel_m == from.travel_m && drive.goal.lift_m == from.lift_m) return {};
  MotionEvent motion;
  motion.kind = "trolley";
  motion.segment = cursor_.segment;
  motion.start_s = time_.now_s();
  if (auto ok = drive_looking(drive, motion); !ok) return ok;
  motion.duration_s = time_.now_s() - motion.start_s;
  const TrolleyState there = ports_.trolley->state();
  motion.trolley = {there.travel_m, there.lift_m};
  // One axis after the other, the arm at rest.
  motion.camera_path_m =
      std::abs(there.travel_m - from.travel_m) + std::abs(there.lift_m - from.lift_m);
  return events_.emit(MotionEnded{std::move(motion)});
}

Expected<void> ArmMover::drive_looking(const Trolley::Drive& drive, MotionEvent& motion) {
  const auto duration = ports_.trolley->set_out(drive);
  if (!duration) return fail_in("trolley", duration.error());
  const bool looks = frames_.wanted() && ports_.trolley->knows_where_it_drives();
  Expected<void> looked;
  if (looks) looked = frames_.set_out(motion.kind);
  if (looks && looked) looked = frames_.go_along(*duration);
  const auto driven = ports_.trolley->arrive();
  const auto frames = frames_.arrive();
  if (!driven) return fail_in("trolley", driven.error());
  if (!looked) return looked;
  if (!frames) return tl::unexpected(frames.error());
  motion.frames = *frames;
  return {};
}

}  // namespace canopeer
