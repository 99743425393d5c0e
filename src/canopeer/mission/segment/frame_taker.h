#pragma once

#include <memory>
#include <optional>

#include "canopeer/map/view_cast.h"
#include "canopeer/mission/perception.h"
#include "canopeer/mission/ports.h"
#include "canopeer/robot/self_filter.h"

namespace canopeer {

/// A frame from where the camera is, and what it taught.
struct Look {
  std::shared_ptr<const RgbdFrame> frame;
  std::shared_ptr<const Detection> detection;
  Observation seen;  ///< without its detection
  /// Of the unknown voxels that the planner's rays crossed from there, those known now; nothing:
  /// not asked for.
  std::optional<std::int64_t> realised_in_fan{};
};

/// Takes frames and hands them to perception.
class FrameTaker {
 public:
  /// All but the options outlive it.
  FrameTaker(const RobotModel& robot, const Ports& ports, const MissionOptions& options,
             Perception& perception);

  /// One frame now. The robot's own links are taken out of it when the options say so. `in_fan`:
  /// Look::realised_in_fan is asked for. The error is the camera's or the detector's.
  [[nodiscard]] Expected<Look> look(const Box& region_world, bool in_fan, WorkMeter& work,
                                    StageTimer& timer);

 private:
  Ports ports_;
  bool mask_robot_;
  ViewFan fan_;
  SelfFilter self_filter_;
  Perception& perception_;
};

}  // namespace canopeer
