#pragma once

#include <memory>

#include "canopeer/mission/perception.h"
#include "canopeer/mission/ports.h"
#include "canopeer/robot/self_filter.h"

namespace canopeer {

/// A frame from where the camera is, and what it taught.
struct Look {
  std::shared_ptr<const RgbdFrame> frame;
  std::shared_ptr<const Detection> detection;
  Observation seen;  ///< without its detection
};

/// Takes frames and hands them to perception.
class FrameTaker {
 public:
  /// All but the options outlive it.
  FrameTaker(const RobotModel& robot, const Ports& ports, const MissionOptions& options,
             Perception& perception);

  /// One frame now. The robot's own links are taken out of it when the options say so. The error is
  /// the camera's or the detector's.
  [[nodiscard]] Expected<Look> look(const Box& region_world, WorkMeter& work, StageTimer& timer);

 private:
  Ports ports_;
  bool mask_robot_;
  SelfFilter self_filter_;
  Perception& perception_;
};

}  // namespace canopeer
