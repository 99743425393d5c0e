#include "canopeer/ros2/trolley/ros2_trolley.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "canopeer/robot/arm_extent.h"
#include "canopeer/ros2/time/figure.h"
#include "canopeer/ros2/trolley/travel_registration.h"

namespace canopeer::ros {
namespace {

constexpr double kAtHome = 0.1;  // each joint, rad (m)

}  // namespace

Expected<std::unique_ptr<Ros2Trolley>> Ros2Trolley::make(const TrolleyParts& parts, const Arm& arm,
                                                         const Ros2Settings& settings,
                                                         std::function<void()> on_moved) {
  auto driver = make_trolley_driver(parts, settings);
  if (!driver) return fail_in("trolley", driver.error());
  return std::unique_ptr<Ros2Trolley>(
      new Ros2Trolley(parts, arm, settings, std::move(*driver), std::move(on_moved)));
}

Expected<void> Ros2Trolley::check_limits(const TrolleyState& goal) const {
  const auto outside = [](const Joint& axis, double value) {
    return value < axis.lower - kLimitTolerance || value > axis.upper + kLimitTolerance;
  };
  if (!outside(parts_.robot.travel_axis(), goal.travel_m) &&
      !outside(parts_.robot.lift_axis(), goal.lift_m)) {
    return {};
  }
  return fail("the goal is beyond the axes' limits (" + in_words(goal, parts_.robot) + ")");
}

/// Whoever drives past plants with the arm stretched out breaks something.
Expected<void> Ros2Trolley::check_arm(bool parked) const {
  if (parts_.arm_fresh) {
    if (auto ok = parts_.arm_fresh(); !ok) return ok;
  }
  const Configuration q = arm_.configuration();
  std::string nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [name, home] : parts_.robot.setup().home) {
    const Configuration there = parts_.robot.endless().nearest(q, home);
    const double away = (there - home).lpNorm<Eigen::Infinity>();
    if (away >= least) continue;
    least = away;
    nearest = name;
  }
  if (least <= kAtHome) return {};
  if (parked) {
    if (keeps_to_aisle(parts_.robot, q)) return {};
    return fail("it must not drive: the arm is neither at home (" + figure(least, 2) +
                " rad from " + nearest +
                " in one joint) nor within the aisle (known_free in the robot's file)");
  }
  return fail("it must not move: the arm is not at home (" + figure(least, 2) + " rad from " +
              nearest + " in one joint); bring it there by hand and start again");
}

Expected<void> Ros2Trolley::move_to(const TrolleyState& goal) {
  if (auto started = set_out({goal}); !started) return tl::unexpected(started.error());
  return arrive();
}

Expected<void> Ros2Trolley::arrive() {
  if (!std::exchange(under_way_, false)) return {};
  auto driven = driver_->finish();
  if (on_moved_) on_moved_();
  return driven;
}

/// 0 and not under way where it is there, or is not to move.
Expected<double> Ros2Trolley::set_out(const Drive& drive) {
  const TrolleyState& goal = drive.goal;
  under_way_ = false;
  if (driver_->at(goal)) return 0.0;
  if (auto ok = check_limits(goal); !ok) return tl::unexpected(ok.error());
  if (dry_run_) {
    parts_.person.tell("dry run: the trolley stays at " + in_words(state(), parts_.robot) +
                       " in place of " + in_words(goal, parts_.robot));
    return 0.0;
  }
  if (auto ok = check_arm(drive.arm_is_parked); !ok) return tl::unexpected(ok.error());
  if (parts_.person.may_move && settings_.kind != Ros2TrolleySettings::Kind::manual &&
      !parts_.person.may_move("drive the trolley to " + in_words(goal, parts_.robot)) &&
      !parts_.person.stop()) {
    return fail("it must not move, a person said; the next segment is elsewhere");
  }
  if (parts_.person.stop()) return 0.0;  // the next question ends the mission
  // The answer may have taken minutes.
  if (auto ok = check_arm(drive.arm_is_parked); !ok) return tl::unexpected(ok.error());
  auto started = driver_->start(goal, drive.max_travel_m_s);
  under_way_ = started.has_value();
  return started;
}

Expected<void> Ros2Trolley::check_place(const VoxelMap* map, RgbdFrame& frame) {
  if (!driver_->in_doubt()) return {};
  driver_->settle();
  if (map == nullptr) return {};
  const TrolleyState believed = state();
  const auto moved = [&](double shift_m) {
    TrolleyState there = believed;
    there.travel_m += shift_m;
    return parts_.robot.T_world_base(there);
  };
  TravelRegistrationOptions options;
  options.reach_m = std::max(settings_.manual_tolerance_m, 2.0 * map->resolution_m());
  const Vec3 axis = moved(1.0).translation() - moved(0.0).translation();
  const TravelRegistration found = register_travel(*map, frame, axis, options);
  parts_.person.tell(in_words(found, believed.travel_m));
  if (found.kind == TravelRegistration::Kind::unclear) {
    auto confirmed = driver_->confirm_again();
    driver_->settle();
    if (on_moved_) on_moved_();
    return confirmed;
  }
  if (found.kind != TravelRegistration::Kind::clear) return {};
  frame.T_world_camera = moved(found.shift_m) * moved(0.0).inverse() * frame.T_world_camera;
  parts_.sense.believe({believed.travel_m + found.shift_m, believed.lift_m});
  return {};
}

}  // namespace canopeer::ros
