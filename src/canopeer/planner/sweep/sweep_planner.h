#pragma once

#include <memory>
#include <vector>

#include "canopeer/planner/coverage/serpentine.h"
#include "canopeer/planner/view_mover.h"

namespace canopeer {

/// The scan, and how much of it is one motion.
struct SweepOptions {
  SerpentineOptions scan;
  double stretch_m = 1.0;  ///< the arm stops when the camera has gone so far: there the next
                           ///< stretch is held against the map as it is by then
  MotionPlannerOptions motion;
};

/// The scan of `coverage` without its stops: the camera goes along the lines of the serpentine and
/// round their ends, as fast as the arm may where frames are wanted on the way
/// (PlanningScene::sharp). Between two points of the scan the arm moves straight in joint space.
/// Points out of reach are left out; where the straight motion is blocked another way round is
/// planned. When all are done it says so, and waits for the end of the segment.
class SweepPlanner : public Planner {
 public:
  explicit SweepPlanner(const SweepOptions& options);

  void begin_segment(const PlanningScene& scene) override;
  void moved(const PlanningScene& scene) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

 private:
  [[nodiscard]] std::vector<Configuration> stretch_from(const Configuration& q, WorkMeter& work);
  [[nodiscard]] std::optional<Configuration> reach_next(const Configuration& near, WorkMeter& work);
  [[nodiscard]] Vec3 camera_base(const Configuration& q) const;

  SweepOptions options_;
  PlanningScene scene_;
  std::unique_ptr<ViewMover> mover_;
  std::vector<FixedView> views_;
  std::size_t next_ = 0;
};

}  // namespace canopeer
