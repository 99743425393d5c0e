#pragma once

#include <memory>
#include <vector>

#include "canopeer/planner/coverage/serpentine.h"
#include "canopeer/planner/patience.h"
#include "canopeer/planner/view_mover.h"

namespace canopeer {

/// The scan, and how the arm moves from view to view.
struct CoverageOptions {
  SerpentineOptions scan;
  MotionPlannerOptions motion;
};

/// A fixed scan that looks at nothing it learns, as scanning rigs do: the serpentine over the
/// workspace facing the row (serpentine.h), views that cannot be reached left out. When all are
/// done it says so, and waits for the end of the segment.
class CoveragePlanner : public Planner {
 public:
  explicit CoveragePlanner(const CoverageOptions& options);

  void begin_segment(const PlanningScene& scene) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

 private:
  CoverageOptions options_;
  PlanningScene scene_;
  std::unique_ptr<ViewMover> mover_;
  std::vector<FixedView> views_;
  std::size_t next_ = 0;
};

}  // namespace canopeer
