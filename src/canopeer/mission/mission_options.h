#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/detector_registry.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/map/fusion.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/planner/registry.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/joint_path.h"
#include "canopeer/robot/motion_planner.h"
#include "canopeer/robot/self_filter.h"

namespace canopeer {

/// One stop of the trolley, at one lift height, looking to one side.
struct SegmentPlan {
  TrolleyState trolley;
  int side = 1;      ///< 1 or 2: which of the robot's boxes and home states
  std::string name;  ///< for people, e.g. "stop 2, side 1"
  /// Its budget, s; 0: the mission's segment_time_s.
  double time_s = 0.0;
  /// Stops along the row that its planner drives between itself; empty: it stays at `trolley`.
  std::vector<TrolleyState> row{};
  int max_views = 0;  ///< it ends after so many; 0: the mission's max_views
};

/// Frames that are taken while the arm or the trolley moves. The paper takes none.
struct OnTheWayOptions {
  double hz = 0.0;  ///< so many a second at most; 0: none
  /// A frame is left out when its image moved farther than this during the exposure, px, where it
  /// moved fastest, at the median distance of what the last frame showed, but no nearer than
  /// sharp_distance_m. 0: any blur.
  double max_blur_px = 3.0;
  double exposure_s = 0.005;  ///< what blur is reckoned with
  CameraIntrinsics camera;    ///< the same
  /// The arm moves to views no faster than `max_blur_px` allows at `sharp_distance_m`.
  bool keep_sharp = false;
  double sharp_distance_m = 0.5;
  /// A frame is left out when the camera has moved less than both since the last one that was not.
  double new_after_m = 0.01;
  double new_after_rad = 0.02;
  /// The same as a limit for whoever times motions; nothing: they are as fast as can be.
  [[nodiscard]] std::optional<ImageMotionLimit> limit() const {
    if (hz <= 0.0 || !keep_sharp || max_blur_px <= 0.0) return std::nullopt;
    return ImageMotionLimit{camera, sharp_distance_m, max_blur_px / exposure_s};
  }
  int queue = 2;  ///< frames that wait while one is worked on; who comes then is too late
  double tell_every_s = 0.25;  ///< how often the planner hears of what they changed
};

/// Whose clock a mission's time is counted by.
enum class MissionClock {
  paper,  ///< each segment's own; transitions are not counted
  whole   ///< one that never stops (mission_time.h)
};

/// Everything a mission does, with no word about the world it does it in.
struct MissionOptions {
  std::string name = "mission";
  std::vector<SegmentPlan> segments;
  /// Transitions between segments are not counted in it. 0: no limit; a segment then ends by its
  /// views, or when its planner is done, or when nothing comes of it any more
  /// (segment/segment_course.h).
  double segment_time_s = 60.0;
  std::string protocol;  ///< name of the rules it is run by (config/protocols.h); empty: own
  int max_views = 0;     ///< a segment ends after so many views; 0: as many as there is time
  bool leave_when_done = false;  ///< a segment ends when its planner says so (Decision::done)
  /// One budget for the whole row: what a segment leaves of its share goes to those behind it. Only
  /// with the whole clock.
  bool shares_time = false;
  MissionClock clock = MissionClock::paper;
  double mission_time_s = 0.0;  ///< T of the whole clock (mission_time.h); 0: the paper's clock
  OnTheWayOptions on_the_way;
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
  DetectorOptions detector;
  FruitMapOptions fruit;
  CollisionOptions collision;
  MotionPlannerOptions motion;
  PlannerOptions planners;
};

}  // namespace canopeer
