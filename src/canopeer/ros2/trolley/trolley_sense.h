#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/time/joint_history.h"
#include "canopeer/ros2/time/ros_clock.h"

namespace canopeer::ros {

/// Where the trolley stands: by joint states, by a topic of its own, or as is believed because
/// nobody says it. Thread-safe.
class TrolleySense {
 public:
  /// `start`: what is believed at first.
  TrolleySense(const RobotModel& robot, const Ros2TrolleySettings& settings,
               const TrolleyState& start);

  /// Subscribes to the topics that say it. `node` and `clock` outlive the sense.
  [[nodiscard]] Expected<void> listen(Node& node, const RosClock& clock);
  /// What joint states have to say, for a JointListener.
  [[nodiscard]] std::vector<JointHistory*> by_joint_states();

  [[nodiscard]] TrolleyState now() const;
  /// Where it stood then; outside what is known: the nearest that is.
  [[nodiscard]] TrolleyState at(Stamp stamp) const;
  /// The newest time of which all axes that anybody speaks of are known; nothing: nobody does.
  [[nodiscard]] std::optional<Stamp> known_until() const;
  /// Counts for axes that nobody says anything of.
  void believe(const TrolleyState& state);
  [[nodiscard]] bool measures_travel() const { return axes_[0].history != nullptr; }
  /// As now(), were `state` believed.
  [[nodiscard]] TrolleyState now_believing(const TrolleyState& state) const;

  /// Axes of which nothing was heard for so long that should be heard, with where it was waited
  /// for: "travel (joint_states)".
  [[nodiscard]] std::vector<std::string> silent(double seconds) const;

 private:
  struct Axis {
    std::string name;                       ///< "travel" or "lift"
    std::string joint;                      ///< of the URDF; empty: there is none
    std::string topic;                      ///< std_msgs/Float64; empty: joint states, or nobody
    std::unique_ptr<JointHistory> history;  ///< null: nobody says it
    std::atomic<double> believed{0.0};
    Subscription subscription;
    [[nodiscard]] double at(Stamp stamp) const;
    [[nodiscard]] double now(double if_unknown) const;
  };
  std::array<Axis, 2> axes_;
};

}  // namespace canopeer::ros
