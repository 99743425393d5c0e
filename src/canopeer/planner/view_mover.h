#pragma once

#include <optional>
#include <vector>

#include "canopeer/planner/planner.h"
#include "canopeer/robot/motion_planner.h"

namespace canopeer {

/// What planners of single views share: an arm configuration for a view, and a globally planned
/// motion there (RRTConnect, OMPL). Each plan draws from a stream of its own, so a run depends on
/// its seed only.
class ViewMover {
 public:
  /// Keeps pointers to what `scene` points to; they must outlive the mover.
  ViewMover(const PlanningScene& scene, const MotionPlannerOptions& options);

  /// The trolley has driven.
  void moved(const PlanningScene& scene);

  /// The collision-free configuration nearest to `near` (Σ|Δq|) in which the camera stands at
  /// `camera_world` and looks at `target_world`, at any roll; nothing: out of reach or blocked.
  [[nodiscard]] std::optional<Configuration> reach(const Vec3& camera_world,
                                                   const Vec3& target_world,
                                                   const Configuration& near,
                                                   WorkMeter& work) const;

  /// Takes the arm from `from` to `to` when a free motion is found within the planner's limits.
  [[nodiscard]] std::optional<Decision> go(const Configuration& from, const Configuration& to,
                                           TargetKind kind, WorkMeter& work);

  /// What has changed since it was made.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(plans_);
  }

 private:
  PlanningScene scene_;
  Pose T_base_world_;
  MotionPlanner planner_;
  std::uint64_t plans_ = 0;
};

}  // namespace canopeer
