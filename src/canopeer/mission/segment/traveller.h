#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/mission/ports.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/motion_planner.h"

namespace canopeer {

/// Takes the arm home by a globally planned motion. It remembers the way it came, so that there is
/// always a way back: where no plan is found it goes back along it until one is, or all the way.
class Traveller {
 public:
  Traveller(const RobotModel& robot, const MotionPlannerOptions& options, std::uint64_t seed);

  /// Joint waypoints from `q` to `home`, both included. Never fails, since the way back is free as
  /// far as anyone knew when it was taken; a goal that is not on it is then out of reach and the
  /// last waypoint is another place than `home`.
  [[nodiscard]] std::vector<Configuration> way_home(const Configuration& q,
                                                    const Configuration& home,
                                                    const CollisionChecker& checker,
                                                    WorkMeter& work);

  /// The arm went along `waypoints`.
  void took(const std::vector<Configuration>& waypoints);
  /// The arm is home: the way back starts anew.
  void forget_way(const Configuration& q);

  /// What later calls depend on.
  struct State {
    std::uint64_t plans = 0;         ///< each draws from a stream of its own
    std::vector<Configuration> way;  ///< since home, in order
    template <typename Archive>
    void serialize(Archive& archive) {
      archive(plans, way);
    }
  };
  [[nodiscard]] const State& state() const { return state_; }
  void restore(State state) { state_ = std::move(state); }

 private:
  MotionPlanner planner_;
  EndlessJoints endless_;
  std::uint64_t seed_;
  State state_;
};

}  // namespace canopeer
