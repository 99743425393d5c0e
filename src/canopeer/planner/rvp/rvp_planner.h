#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/planner/patience.h"
#include "canopeer/planner/rvp/roi_nearness.h"
#include "canopeer/planner/view_mover.h"

namespace canopeer {

/// Which views are drawn, what they are worth, and how hard motions are planned.
struct RvpOptions {
  int views_per_kind = 100;     ///< drawn around ROI frontiers, and around occupied ones
  double min_distance_m = 0.3;  ///< camera to target
  double max_distance_m = 0.5;
  double distance_weight = 0.2;  ///< utility = gain − this · distance of the camera (1/m)
  double roi_threshold = 0.2;    ///< the ROI views are taken when the best of them is worth more
  int max_plans = 20;            ///< motions planned in one decision at most
  /// The published planner gives up a motion after 5 s. Limits here are counts: 5 s are about
  /// 42 000 of the published system's state checks.
  MotionPlannerOptions motion{.max_iterations = 3000};
};

/// Single next-best view around regions of interest: T. Zaenker, C. Smitt, C. McCool, M. Bennewitz,
/// "Viewpoint Planning for Fruit Size and Position Estimation", IROS 2021, and its predecessors;
/// the baseline "RVP" of [Zaenker23]. Each step draws views at the contours of ROIs and of what is
/// occupied, weighs their information gain against the distance to go, and takes the best one that
/// a global motion planner reaches. No motion cost, no look-ahead. Departures: docs/method.md.
class RvpPlanner : public Planner {
 public:
  explicit RvpPlanner(const RvpOptions& options);

  void begin_segment(const PlanningScene& scene) override;
  void map_changed(MapChange change) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  void time_passes(double seconds) override { patience_.time_passes(seconds); }
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

  /// Gain of the ray camera → target: Σ over its unknown voxels of 0.5 + 0.5·v by the number of
  /// its voxels, v the nearness to a ROI.
  [[nodiscard]] double ray_gain(const Vec3& camera_world, const Vec3& target_world) const;
  /// Away from the occupied voxels around a free one; nothing where they cancel out.
  [[nodiscard]] std::optional<Vec3> surface_normal(const VoxelIndex& target) const;

 private:
  struct Candidate {
    Vec3 camera_world = Vec3::Zero();
    Vec3 target_world = Vec3::Zero();
    TargetKind kind = TargetKind::none;
    double utility = 0.0;
  };
  void find_regions();
  [[nodiscard]] std::vector<Candidate> draw_views(TargetKind kind, const Vec3& camera_now,
                                                  WorkMeter& work);
  [[nodiscard]] std::vector<Candidate> draw_and_choose(const Configuration& q, WorkMeter& work);

  RvpOptions options_;
  PlanningScene scene_;
  std::unique_ptr<ViewMover> mover_;
  FrontierTargets targets_;
  RoiNearness nearness_;
  Rng rng_{0};
  Patience patience_;
};

}  // namespace canopeer
