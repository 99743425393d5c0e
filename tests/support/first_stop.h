#pragma once

#include "canopeer/mission/perception.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/scene/scene.h"
#include "canopeer/viewgraph/segment_frame.h"

namespace canopeer::test {

/// A robot at stop 1, side 1 of Scenario 1 (seed 1), and what it knows of it: nothing at first.
class FirstStop {
 public:
  explicit FirstStop(const RobotModel& model);
  FirstStop(const FirstStop&) = delete;
  FirstStop& operator=(const FirstStop&) = delete;

  /// Fuses a frame; what it taught.
  Observation see(const RgbdFrame& seen);

  RobotModel robot;
  ArmIk ik;
  Scene scene;
  MissionOptions mission;
  Perception perception;
  SegmentFrame frame;
  CollisionChecker checker;
};

}  // namespace canopeer::test
