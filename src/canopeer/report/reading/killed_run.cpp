#include "canopeer/report/reading/killed_run.h"

#include <cmath>
#include <numbers>

namespace canopeer {

Summary summary_from_record(const RunRecord& record) {
  Summary s;
  s.canopeer_version = record.header.canopeer_version;
  s.mission = record.header.mission;
  s.planner = record.header.planner;
  s.seed = record.header.seed;
  s.compute_table = record.header.compute_table;
  s.segments = static_cast<int>(record.segments.size());
  s.interrupted = true;
  s.sim_time_s = record.end_s;
  s.views = static_cast<int>(record.views.size());
  if (!record.views.empty()) {
    s.roi_voxels = record.views.back().roi_voxels;
    s.fruits_reported = static_cast<int>(record.views.back().fruits.size());
  }
  for (const ViewEvent& view : record.views) s.planning_time_s += view.planning_s;
  for (const MotionEvent& motion : record.motions) {
    s.joint_path_length_rad += motion.joint_path_rad;
    s.motion_time_s += motion.duration_s;
    s.collisions += motion.collision ? 1 : 0;
    s.plant_contacts += motion.plant_contact ? 1 : 0;
  }
  return s;
}

std::vector<FruitEstimate> fruits_from_record(const RunRecord& record) {
  std::vector<FruitEstimate> fruits;
  if (record.views.empty()) return fruits;
  for (const FruitSnapshot& snapshot : record.views.back().fruits) {
    FruitEstimate fruit;
    fruit.id = snapshot.id;
    fruit.centre = snapshot.centre;
    fruit.volume_cm3 = snapshot.volume_cm3;
    const double radius_m = std::cbrt(0.75e-6 * snapshot.volume_cm3 / std::numbers::pi);
    fruit.semi_axes_m.setConstant(radius_m);
    fruits.push_back(fruit);
  }
  return fruits;
}

}  // namespace canopeer
