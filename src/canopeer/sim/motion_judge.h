#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "canopeer/robot/exact_checker.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// What a motion ran into.
struct Verdict {
  bool collision =
      false;  ///< the robot itself, the structure, or voxels mapped when the motion started
  bool plant_contact = false;  ///< a plant
};

/// Looks at motions as they are executed, with FCL on the true geometry of robot, structure and
/// plants. FCL is asked about states only that a quick and careful look (NearSpace) does not call
/// free. So verdicts are FCL's.
class MotionJudge {
 public:
  /// `step_m`: between two states looked at no point of the arm moves farther. `robot` and `scene`
  /// outlive the judge.
  MotionJudge(const RobotModel& robot, const Scene& scene, double step_m = 0.01);

  /// Motion along the waypoints with the trolley at rest; `map`: what is known when it starts, or
  /// null.
  [[nodiscard]] Verdict judge(const std::vector<Configuration>& waypoints,
                              const TrolleyState& trolley, const VoxelMap* map) const;
  /// The exact checker with the scene's structure in it.
  [[nodiscard]] const ExactChecker& checker() const { return checker_; }

 private:
  struct Stop;
  [[nodiscard]] std::shared_ptr<Stop> stop_at(const TrolleyState& trolley, const Configuration& q,
                                              const VoxelMap* map) const;

  double step_rad_;
  const RobotModel& robot_;
  const Scene& scene_;
  ExactChecker checker_;
  mutable std::mutex mutex_;  // of stop_ and the space in it
  mutable std::shared_ptr<Stop> stop_;
};

}  // namespace canopeer
