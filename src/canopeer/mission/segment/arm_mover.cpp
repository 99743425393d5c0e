#include "canopeer/mission/segment/arm_mover.h"

#include <utility>

#include "canopeer/robot/corner_rounding.h"

namespace canopeer {

ArmMover::ArmMover(const RobotModel& robot, const Ports& ports, Traveller& traveller,
                   Timekeeper& time, EventHub& events, MissionCursor& cursor)
    : robot_(robot),
      ports_(ports),
      traveller_(traveller),
      time_(time),
      events_(events),
      cursor_(cursor) {}

Expected<void> ArmMover::move(const std::string& kind, const std::vector<Configuration>& waypoints,
                              const CollisionChecker& checker) {
  const JointPath path = without_needless_stops(waypoints, checker);
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
  const auto duration = time_.timer().time("arm", [&] { return ports_.arm->start(path); });
  if (!duration) return fail_in("arm", duration.error());
  auto told = events_.emit(MotionBegun{kind, motion.segment, motion.start_s, *duration, path});
  time_.goes_on(*duration);
  const auto outcome = time_.timer().time("arm", [&] { return ports_.arm->finish(); });
  if (!outcome) return fail_in("arm", outcome.error());
  traveller_.took(waypoints);
  motion.duration_s = time_.now_s() - motion.start_s;
  motion.collision = outcome->collision;
  motion.plant_contact = outcome->plant_contact;
  cursor_.last_standing_s = motion.start_s - cursor_.standing_since_s;
  cursor_.last_motion_s = motion.duration_s;
  cursor_.standing_since_s = time_.now_s();
  if (!told) return told;
  return events_.emit(MotionEnded{std::move(motion)});
}

JointPath ArmMover::without_needless_stops(const std::vector<Configuration>& waypoints,
                                           const CollisionChecker& checker) {
  if (waypoints.size() < 3) return {waypoints};
  int states = 0;
  JointPath path = time_.timer().time(
      "arm", [&] { return round_corners(waypoints, robot_.limits(), checker, states); });
  WorkMeter work;
  work.add(Work::motion_plan, states);
  time_.pay(work);
  return path;
}

Expected<void> ArmMover::go_home(const Configuration& home, const CollisionChecker& checker) {
  WorkMeter work;
  const auto way = time_.timer().time(
      "way home", [&] { return traveller_.way_home(where(), home, checker, work); });
  time_.pay(work);
  if (way.size() > 1) {
    if (auto ok = move("home", way, checker); !ok) return ok;
  }
  if (robot_.endless().distance(way.back(), home) > 1e-9) {
    return fail("segment " + std::to_string(cursor_.segment) +
                ": no collision-free way home was found; is the home state of the next segment "
                "blocked by plants?");
  }
  traveller_.forget_way(where());
  return {};
}

Expected<void> ArmMover::drive(const TrolleyState& goal) {
  const TrolleyState from = ports_.trolley->state();
  if (goal.travel_m == from.travel_m && goal.lift_m == from.lift_m) return {};
  MotionEvent motion;
  motion.kind = "trolley";
  motion.segment = cursor_.segment;
  motion.start_s = time_.now_s();
  if (auto ok = ports_.trolley->move_to(goal); !ok) return fail_in("trolley", ok.error());
  motion.duration_s = time_.now_s() - motion.start_s;
  return events_.emit(MotionEnded{std::move(motion)});
}

}  // namespace canopeer
