#pragma once

#include <memory>
#include <optional>

#include "canopeer/base/rng.h"
#include "canopeer/planner/patience.h"
#include "canopeer/planner/view_mover.h"

namespace canopeer {

/// How many views a decision draws and tries.
struct RandomOptions {
  double min_target_distance_m = 0.3;  ///< nearest camera position to what it looks at
  int max_tries = 200;  ///< views drawn for one decision; then it waits and draws others
  int max_plans = 10;   ///< of these, motions planned
  MotionPlannerOptions motion;
};

/// Uniform reachable views, blind to the map: a camera position uniform in the workspace looks at a
/// point uniform in the sampling region; taken when the arm can get there. The classic lower bound
/// of view planning (e.g. Delmerico et al., Autonomous Robots 2018, compare against it).
class RandomPlanner : public Planner {
 public:
  explicit RandomPlanner(const RandomOptions& options);

  void begin_segment(const PlanningScene& scene) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  void time_passes(double seconds) override { patience_.time_passes(seconds); }
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

 private:
  struct Sight {
    Vec3 camera_world;
    Vec3 target_world;
  };
  Sight draw();

  RandomOptions options_;
  PlanningScene scene_;
  std::unique_ptr<ViewMover> mover_;
  Rng rng_{0};
  Patience patience_;
};

}  // namespace canopeer
