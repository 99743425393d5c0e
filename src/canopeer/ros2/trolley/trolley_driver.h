#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/arm/person_hooks.h"
#include "canopeer/ros2/trolley/trolley_sense.h"

namespace canopeer::ros {

/// How a trolley gets to a place: one class a kind.
class TrolleyDriver {
 public:
  virtual ~TrolleyDriver() = default;
  /// What it needs and does not find, for people; empty: all is there.
  [[nodiscard]] virtual std::vector<std::string> missing() const { return {}; }
  /// Goes there, and waits. A person who stops the run ends it early, which is no error.
  [[nodiscard]] virtual Expected<void> drive(const TrolleyState& goal) = 0;
  /// The same in two calls, for those who look around on the way: sets out, along the row no faster
  /// than `max_travel_m_s` (0: as fast as it can), and returns how long it will take, s; 0: not
  /// known. The error: it cannot be told how fast.
  [[nodiscard]] virtual Expected<double> start(const TrolleyState& goal, double max_travel_m_s);
  /// Waits for the end of the drive started last.
  [[nodiscard]] virtual Expected<void> finish() { return drive(goal_); }
  /// Whether it is at `goal` already.
  [[nodiscard]] virtual bool at(const TrolleyState& goal) const = 0;
  /// Whether the map should say where it stands, and the end of that doubt.
  [[nodiscard]] virtual bool in_doubt() const { return false; }
  virtual void settle() {}
  /// The map does not show the place: a person looks again and says so. Waits for that.
  [[nodiscard]] virtual Expected<void> confirm_again() { return {}; }

 private:
  TrolleyState goal_;  ///< of start()
};

/// All outlive the driver.
struct TrolleyParts {
  Node& node;
  const RobotModel& robot;
  TrolleySense& sense;
  RosClock& clock;
  PersonHooks person;
  /// The error: nobody knows where the arm is any more. Empty: it is known.
  std::function<Expected<void>()> arm_fresh{};

  /// The error: the clock stands, the arm is not known, or nothing was heard of an axis for so
  /// long.
  [[nodiscard]] Expected<void> alive(double max_silence_s) const;
};

/// The driver for the settings' kind. The error: a topic, action or service cannot be had.
[[nodiscard]] Expected<std::unique_ptr<TrolleyDriver>> make_trolley_driver(
    const TrolleyParts& parts, const Ros2Settings& settings);

/// Whether each axis is within `tolerance_m` of a place.
[[nodiscard]] bool stands_at(const TrolleyState& state, const TrolleyState& goal,
                             double tolerance_m);
/// "travel 1.200 m, lift 0.300 m", without axes that the robot does not have.
[[nodiscard]] std::string in_words(const TrolleyState& state, const RobotModel& robot);

}  // namespace canopeer::ros
