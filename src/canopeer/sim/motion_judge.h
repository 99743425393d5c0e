#pragma once

#include <cstddef>
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
  /// `step_m`: between two states looked at no point of the arm moves farther. `stops`: places of
  /// the trolley whose surroundings, triangles and boxes around them, are kept, the last ones.
  /// `robot` and `scene` outlive the judge.
  MotionJudge(const RobotModel& robot, const Scene& scene, double step_m = 0.01, int stops = 1);

  /// Motion along the waypoints with the trolley at rest; `map`: what is known when it starts, or
  /// null.
  [[nodiscard]] Verdict judge(const std::vector<Configuration>& waypoints,
                              const TrolleyState& trolley, const VoxelMap* map) const;
  /// Whether judge() without a map finds nothing. It looks at states far apart first, up to the
  /// first that touches: quicker, where many motions are not free.
  [[nodiscard]] bool free(const std::vector<Configuration>& waypoints,
                          const TrolleyState& trolley) const;
  /// The exact checker with the scene's structure in it.
  [[nodiscard]] const ExactChecker& checker() const { return checker_; }

 private:
  struct Stop;
  [[nodiscard]] bool touches(const Configuration& q, const TrolleyState& trolley, Stop& stop) const;
  [[nodiscard]] std::shared_ptr<Stop> stop_at(const TrolleyState& trolley, const Configuration& q,
                                              const VoxelMap* map) const;

  double step_rad_;
  const RobotModel& robot_;
  const Scene& scene_;
  ExactChecker checker_;
  std::size_t most_stops_;
  mutable std::mutex mutex_;                          // of stops_ and the spaces in them
  mutable std::vector<std::shared_ptr<Stop>> stops_;  // the last one in front
};

}  // namespace canopeer
