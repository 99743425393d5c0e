#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "canopeer/planner/coverage/row_ahead.h"
#include "canopeer/planner/view_mover.h"

namespace canopeer {

/// Where the camera is parked, and how far the trolley drives.
struct DriveByOptions {
  int poses = 2;                ///< heights the camera is parked at, one after the other; 1 … 3
  double row_distance_m = 0.6;  ///< from the camera to the middle of the sampling region, at least
  double tilt_rad = 0.5;        ///< of the later rounds: left, right, up, down; 0: one round only
  double overrun_m = 0.5;       ///< how far beyond the first and last stop, where the rails go on
  MotionPlannerOptions motion;
};

/// The arm parked, the trolley drives: what growers can buy. At each lift height the camera is
/// parked at `poses` heights, facing the row, and with each the trolley drives to the other end of
/// the row, no faster than frames stay sharp (PlanningScene::sharp; nothing: as fast as it can).
/// Then the same again with the camera tilted left, right, up and down. When all is done it says
/// so. Frames on the way are all it sees but for one at each end; where none are taken it stops to
/// look every 0.3 m.
///
/// The heights divide the part of the workspace that is as high as the sampling region evenly. Of
/// the places along the row and at least so far from it the one nearest to the workspace's middle
/// is taken that the arm reaches, and where it keeps to the aisle (keeps_to_aisle(); anywhere,
/// where no aisle is known). Nothing else holds the parked arm against the map while it drives.
/// Poses that no motion leads to are left out; when that is all of them it is stuck. So it is when
/// the arm stands where the trolley must not drive.
///
/// In a segment without SegmentFrame::row the trolley stays where it is.
class DriveByPlanner : public Planner {
 public:
  explicit DriveByPlanner(const DriveByOptions& options);

  void begin_segment(const PlanningScene& scene) override;
  void moved(const PlanningScene& scene) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

 private:
  struct Pass {  // one drive along the row
    double lift_m = 0.0;
    double height_m = 0.0;  // of the camera, arm base frame
    Vec3 direction_base = Vec3::UnitY();
  };
  void plan_passes();
  [[nodiscard]] std::vector<double> heights() const;
  void next_pass();
  [[nodiscard]] std::optional<Decision> park(const Pass& pass, const Configuration& q,
                                             WorkMeter& work);
  [[nodiscard]] std::optional<Configuration> parking(const Vec3& camera_base, const Pass& pass,
                                                     const Configuration& q, WorkMeter& work) const;
  [[nodiscard]] bool may_drive(const Configuration& q) const;
  [[nodiscard]] std::optional<TrolleyState> next_end(double lift_m);
  [[nodiscard]] Decision drive(const TrolleyState& goal, const Configuration& q) const;

  DriveByOptions options_;
  PlanningScene scene_;
  std::unique_ptr<ViewMover> mover_;
  Box region_base_;  // as it was when the segment began: rounding differs at other stops
  RowAhead row_;
  std::vector<Pass> passes_;
  std::size_t next_ = 0;
  int motions_ = 0;  // to the pose of this pass
  int drives_ = 0;   // along the row in this pass
  std::optional<Configuration> parked_;
  bool lifted_ = false;           ///< it was told to, in this pass
  std::optional<double> goal_m_;  ///< where it drives to at present
  bool ever_parked_ = false;
};

}  // namespace canopeer
