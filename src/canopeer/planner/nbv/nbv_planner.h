#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "canopeer/planner/nbv/fruit_distance.h"
#include "canopeer/planner/nbv/nbv_options.h"
#include "canopeer/planner/nbv/view_rays.h"
#include "canopeer/planner/patience.h"
#include "canopeer/planner/view_mover.h"
#include "canopeer/viewgraph/view_sampler.h"

namespace canopeer {

/// The next best view by a published gain (Cuaran et al., arXiv 2412.10515). Each step draws views
/// at the frontiers, as VMP does, divides their gains by the highest, subtracts the way there, and
/// takes the best one that a global motion planner reaches. As long as no view gains anything (no
/// fruit is known yet), they are ranked by unknown voxels. Departures: docs/method.md.
class NbvPlanner : public Planner {
 public:
  /// `shares`, `sampler`: where views are drawn; `fan`: their rays, which go on through any
  /// unknown space.
  NbvPlanner(const NbvOptions& options, const TargetShares& shares,
             const ViewSamplerOptions& sampler, const ViewFan& fan);

  void begin_segment(const PlanningScene& scene) override;
  void map_changed(MapChange change) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  void time_passes(double seconds) override { patience_.time_passes(seconds); }
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

 private:
  struct RatedView {
    ViewPose view;
    double gain = 0.0;
    double utility = 0.0;
  };
  void look_at_map();
  [[nodiscard]] std::vector<RatedView> draw_views(WorkMeter& work);
  void rate(std::vector<RatedView>& views, NbvGain gain, WorkMeter& work) const;

  NbvOptions options_;
  TargetShares shares_;
  ViewSamplerOptions sampler_options_;
  ViewFan fan_;
  PlanningScene scene_;
  std::optional<ViewSampler> sampler_;
  std::unique_ptr<ViewMover> mover_;
  FrontierTargets frontiers_;
  TargetSampler targets_;
  FruitDistance fruit_;
  Rng rng_{0};
  Patience patience_;
};

}  // namespace canopeer
