#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "canopeer/detect/detector.h"
#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/mission/steering.h"
#include "canopeer/planner/plan_sketch.h"
#include "canopeer/record/run_record.h"
#include "canopeer/robot/joint_path.h"
#include "canopeer/sensing/camera_twist.h"
#include "canopeer/sensing/rgbd_frame.h"

// What a mission says while it works: values, safe to keep and to pass to other threads. What is
// big is shared and never changed; what costs time to make is there only when a listener wants it
// (EventNeeds). Times are mission time, s.

namespace canopeer {

struct SurfaceMesh;  // fruit/fruit_map.h

/// The mission begins, or goes on in the middle.
struct RunBegun {
  double t_s = 0.0;
  int segments = 0;
  double segment_time_s = 0.0;
  bool resumed = false;
  std::optional<SegmentEvent> segment;  ///< that is under way, when resumed in the middle of one
};

/// The trolley stands at a stop, the arm at home; `segment.end_s` is not known yet.
struct SegmentBegun {
  SegmentEvent segment;
};

/// Its time is up, or somebody ended it. The way home comes after.
struct SegmentEnded {
  int segment = 0;
  double end_s = 0.0;
  std::shared_ptr<const SurfaceMesh> surface{};  ///< of the fruits, now; EventNeeds::surface
};

/// A frame was taken and everything learnt from it.
struct FrameTaken {
  ViewEvent view;
  std::shared_ptr<const RgbdFrame> frame;      ///< with pose and time; the robot masked out
  std::shared_ptr<const Detection> detection;  ///< fruit pixels, of the frame's size
};

/// A frame was taken on the way and everything learnt from it. MapChanged and FruitsFound come
/// after several of them.
struct FrameOnTheWay {
  FrameEvent frame;
  CameraTwist twist{};                         ///< then
  std::shared_ptr<const RgbdFrame> images;     ///< with pose and time; the robot masked out
  std::shared_ptr<const Detection> detection;  ///< fruit pixels, of the frame's size
};

/// The voxel map changed by the frame of this view, or by frames on the way from it.
struct MapChanged {
  double t_s = 0.0;
  int view = 0;
  std::vector<BlockKey> blocks;  ///< whose voxels changed, sorted
  // With EventNeeds::map, else null:
  std::shared_ptr<const FrontierTargets> targets;  ///< all inside the sampling region
  std::shared_ptr<const VoxelMap> map;             ///< as it is now
};

/// The fruit map after the frame of this view; at the end once more, with all shapes fitted anew.
struct FruitsFound {
  double t_s = 0.0;
  int view = 0;                       ///< −1: no frame was taken
  std::vector<FruitEstimate> fruits;  ///< by ascending id
};

/// The planner decided to move.
struct Planned {
  double t_s = 0.0;
  int segment = 0;
  std::vector<Configuration> waypoints;  ///< of the next motion, rad
  Pose T_world_camera = Pose::Identity();
  TargetKind kind = TargetKind::none;
  std::optional<std::int64_t> predicted_gain;  ///< unknown voxels
  std::shared_ptr<const PlanSketch> sketch;    ///< graph and path; EventNeeds::plan
};

/// The arm sets out along `path`.
struct MotionBegun {
  std::string kind;  ///< "view" or "home"
  int segment = 0;
  double start_s = 0.0;
  double duration_s = 0.0;  ///< expected
  JointPath path;
};

/// The arm, or the trolley, has arrived.
struct MotionEnded {
  MotionEvent motion;
};

/// A port, the detector or a keeper failed; the run ends.
struct Fault {
  double t_s = 0.0;
  std::string message;
};

/// Somebody steered: anything but "go on", and "go on" after a hold.
struct Steered {
  double t_s = 0.0;
  int segment = 0;
  SteeringWord word;
};

/// Work counted since the run began, after each segment and at the end.
struct WorkDone {
  std::vector<WorkItem> work;
  TimeSplit time{};  ///< where the mission's time went
};

/// The last event.
struct RunEnded {
  double end_s = 0.0;
  bool interrupted = false;
  std::shared_ptr<const SurfaceMesh> surface{};  ///< of the fruits; EventNeeds::surface
};

using Event = std::variant<RunBegun, SegmentBegun, SegmentEnded, FrameTaken, FrameOnTheWay,
                           MapChanged, FruitsFound, Planned, MotionBegun, MotionEnded, Fault,
                           Steered, WorkDone, RunEnded>;

/// What of an event is made only on demand. A listener is asked for it once, when it is registered.
struct EventNeeds {
  bool map = false;   ///< MapChanged::map: a snapshot, which makes the mission copy what it changes
  bool plan = false;  ///< Planned::sketch
  bool surface = false;  ///< SegmentEnded::surface, RunEnded::surface
};

}  // namespace canopeer
