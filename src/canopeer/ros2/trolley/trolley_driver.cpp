#include "canopeer/ros2/trolley/trolley_driver.h"

#include <cmath>

#include "canopeer/ros2/time/figure.h"
#include "canopeer/ros2/trolley/manual_driver.h"
#include "canopeer/ros2/trolley/topics_driver.h"
#include "canopeer/ros2/trolley/trajectory_driver.h"

namespace canopeer::ros {
namespace {

class FixedDriver : public TrolleyDriver {
 public:
  FixedDriver(const TrolleyParts& parts, double tolerance_m)
      : parts_(parts), tolerance_m_(tolerance_m) {}
  bool at(const TrolleyState& goal) const override {
    return stands_at(parts_.sense.now(), goal, tolerance_m_);
  }
  Expected<void> drive(const TrolleyState& goal) override {
    return fail("it is fixed at " + in_words(parts_.sense.now(), parts_.robot) +
                " (ros2.trolley.kind), and the mission wants " + in_words(goal, parts_.robot));
  }
  Expected<double> start(const TrolleyState& goal, double) override {
    return tl::unexpected(drive(goal).error());
  }

 private:
  TrolleyParts parts_;
  double tolerance_m_;
};

}  // namespace

Expected<double> TrolleyDriver::start(const TrolleyState& goal, double max_travel_m_s) {
  if (max_travel_m_s > 0.0) {
    return fail(
        "it cannot be told how fast to drive (ros2.trolley.kind); expected a trolley of kind "
        "'trajectory', or missions that want no speed");
  }
  goal_ = goal;
  return 0.0;
}

Expected<void> TrolleyParts::alive(double max_silence_s) const {
  if (auto ok = clock.check(); !ok) return ok;
  if (arm_fresh) {
    if (auto ok = arm_fresh(); !ok) return ok;
  }
  const auto silent = sense.silent(max_silence_s);
  if (silent.empty()) return {};
  return fail("lost it: nothing was heard of " + silent.front() + " for " +
              figure(max_silence_s, 1) + " s");
}

bool stands_at(const TrolleyState& state, const TrolleyState& goal, double tolerance_m) {
  return std::abs(state.travel_m - goal.travel_m) <= tolerance_m &&
         std::abs(state.lift_m - goal.lift_m) <= tolerance_m;
}

std::string in_words(const TrolleyState& state, const RobotModel& robot) {
  std::string text;
  if (!robot.setup().travel_joint.empty()) text = "travel " + figure(state.travel_m, 3) + " m";
  if (!robot.setup().lift_joint.empty()) {
    text += (text.empty() ? "lift " : ", lift ") + figure(state.lift_m, 3) + " m";
  }
  return text.empty() ? "where it is" : text;
}

Expected<std::unique_ptr<TrolleyDriver>> make_trolley_driver(const TrolleyParts& parts,
                                                             const Ros2Settings& settings) {
  using Kind = Ros2TrolleySettings::Kind;
  switch (settings.trolley.kind) {
    case Kind::trajectory:
      return make_trajectory_driver(parts, settings);
    case Kind::topics:
      return make_topics_driver(parts, settings.trolley);
    case Kind::manual:
      return make_manual_driver(parts, settings.trolley);
    case Kind::fixed:
      break;
  }
  return std::make_unique<FixedDriver>(parts, settings.trolley.tolerance_m);
}

}  // namespace canopeer::ros
