#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/color_detector.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/map/fusion.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/planner/registry.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/motion_planner.h"
#include "canopeer/robot/self_filter.h"

namespace canopeer {

/// One stop of the trolley, at one lift height, looking to one side.
struct SegmentPlan {
  TrolleyState trolley;
  int side = 1;      ///< 1 or 2: which of the robot's boxes and home states
  std::string name;  ///< for people, e.g. "stop 2, side 1"
};

/// Everything a mission does, with no word about the world it does it in.
struct MissionOptions {
  std::string name = "mission";
  std::vector<SegmentPlan> segments;
  double segment_time_s = 60.0;  ///< transitions between segments are not counted in it
  std::string planner = "vmp";
  std::uint64_t seed = 1;
  CostTable costs;
  /// Threads that work for the planner on the wall clock; 0: time is simulated, and background work
  /// is done in the time the cost table gives it.
  int background_workers = 0;
  VoxelMapOptions map;
  FusionOptions fusion;
  /// The robot's own links are taken out of every frame before anything else looks at it. A real
  /// camera needs that; the simulated one does not show the robot.
  bool mask_robot = false;
  SelfFilterOptions self_filter;
  double field_truncation_m = 0.15;  ///< distances to occupied voxels are known up to here
  double field_reach_m = 1.4;  ///< half side of the box around the arm's base in which they are
  ColorDetectorOptions detector;
  FruitMapOptions fruit;
  CollisionOptions collision;
  MotionPlannerOptions motion;
  PlannerOptions planners;
};

}  // namespace canopeer
