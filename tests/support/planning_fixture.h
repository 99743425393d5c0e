#pragma once

#include <memory>

#include "canopeer/mission/perception.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/simulation.h"
#include "canopeer/viewgraph/segment_frame.h"

namespace canopeer::test {

/// The robot that ships with the project.
const RobotModel& test_robot();

/// The shipped robot at stop 1, side 1 of Scenario 1 (seed 1), its home frame fused: what planning
/// starts from.
class PlanningFixture {
 public:
  explicit PlanningFixture(SimulationOptions options = {});

  const RobotModel& robot;
  ArmIk ik;
  Scene scene;
  Simulation simulation;
  MissionOptions mission;
  Perception perception;
  SegmentFrame frame;
  CollisionChecker checker;
  Observation home;  ///< what the home frame taught
};

}  // namespace canopeer::test
