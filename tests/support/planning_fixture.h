#pragma once

#include "canopeer/sim/simulation.h"
#include "support/first_stop.h"

namespace canopeer::test {

/// The robot that ships with the project.
const RobotModel& test_robot();

/// The shipped robot at its first stop, simulated, its home frame fused: what planning starts from.
class PlanningFixture : public FirstStop {
 public:
  explicit PlanningFixture(SimulationOptions options = {});

  /// Fuses a frame from where the arm is; what it taught.
  Observation look();

  Simulation simulation;
  Observation home;  ///< what the home frame taught
};

}  // namespace canopeer::test
