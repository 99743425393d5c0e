#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/base/expected.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/planner/plan_sketch.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/joint_path.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/viewgraph/segment_frame.h"
#include "canopeer/viewgraph/view_pose.h"

namespace canopeer {

/// A motion to the next view, and what the planner hopes to see there.
struct ViewMotion {
  std::vector<Configuration>
      waypoints;  ///< first: where the arm is; straight joint motions in between
  Pose T_world_camera = Pose::Identity();  ///< camera at the end
  TargetKind kind = TargetKind::none;
  std::optional<std::int64_t>
      predicted_gain;  ///< unknown voxels this view is expected to add; nothing: not predicted
};

/// A drive along the row, for planners that look from the moving trolley.
struct RowDrive {
  TrolleyState goal;
  double max_travel_m_s = 0.0;  ///< 0: as fast as it can
};

/// What the arm should do now.
struct Decision {
  enum class Action {
    move,   ///< take `motion`
    wait,   ///< nothing to go for yet; ask again after some background work
    stuck,  ///< no way on from here; a move home may help
    drive,  ///< drive the trolley: `drive`; the arm stays as it is
    done    ///< nothing here is worth going for any more; the segment ends where it may
  };
  Action action = Action::wait;
  ViewMotion motion;
  RowDrive drive{};
};

/// The map as one frame left it, its distances and a checker on them, for readers in other threads
/// while the next frame is fused. Never changed; costs a pointer a page of the map and a copy of
/// the distances.
struct MapSnapshot {
  MapSnapshot(const VoxelMap& map_now, const DistanceField& field_now,
              const CollisionChecker& checker_now)
      : map(map_now), field(field_now), checker(checker_now) {
    checker.set_map(&field);
  }
  MapSnapshot(const MapSnapshot&) = delete;
  MapSnapshot& operator=(const MapSnapshot&) = delete;

  VoxelMap map;
  DistanceField field;
  CollisionChecker checker;
};

/// All a planner may know about the robot and the map in one segment. The map and the checker (on
/// the map's distance field) are those of the last fused frame and do not change during a call.
struct PlanningScene {
  const RobotModel* robot = nullptr;
  const ArmIk* ik = nullptr;
  const VoxelMap* map = nullptr;
  const CollisionChecker* checker = nullptr;  ///< fast and conservative
  const ExactChecker* judge = nullptr;        ///< slow and exact
  const CostTable* costs = nullptr;
  /// What background tasks read, on the wall clock; null in simulated time, where nothing changes
  /// while a task runs: map and checker.
  std::shared_ptr<const MapSnapshot> snapshot{};
  SegmentFrame segment;
  std::uint64_t seed = 1;
  /// Of the segment, when it begins (of the rest of it in restore()), s; infinite: no limit.
  double time_left_s = std::numeric_limits<double>::infinity();
  bool looks_on_the_way = false;  ///< frames are taken while the arm or the trolley moves
  /// The arm moves no faster than this, so that they are sharp; nothing: as fast as it can.
  std::optional<ImageMotionLimit> sharp{};
};

/// What has changed since the last call of Planner::map_changed.
struct MapChange {
  std::vector<BlockKey> blocks;  ///< sorted
  FrontierTargets targets;       ///< all of them, re-extracted inside the sampling region
  std::shared_ptr<const MapSnapshot> snapshot{};  ///< takes the place of the scene's
};

/// All zero for planners without a graph.
struct PlannerStatus {
  int graph_nodes = 0;
  int graph_edges = 0;
  // In the present segment:
  int searches = 0;
  int blocked_edges = 0;   ///< taken out because the new map blocks them
  int off_pose_nodes = 0;  ///< put in because the arm was where no node is, the start included

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(graph_nodes, graph_edges, searches, blocked_edges, off_pose_nodes);
  }
};

/// A piece of background work. run() reads the scene's snapshot (in simulated time its map and
/// checker) and nothing else of the planner, so it may go on in another thread beside the planner's
/// calls and while a frame is fused.
class BackgroundTask {
 public:
  virtual ~BackgroundTask() = default;
  virtual void run() = 0;
};

/// A view planner. The mission calls it from one thread at a time: begin_segment, then for every
/// view map_changed and decide (again after `wait`). For the time that passes while the arm moves
/// or decide is paid for it calls grow (in simulated time), or time_passes, with worker threads
/// that make tasks (on the wall clock). A planner overrides what it needs: begin_segment and decide
/// are enough.
class Planner {
 public:
  virtual ~Planner() = default;

  /// Forgets the last segment. `scene` stays valid until the next call of this, of moved or of
  /// restore.
  virtual void begin_segment(const PlanningScene& scene) = 0;
  /// The trolley has driven: the scene's trolley, frame and checker are new.
  virtual void moved(const PlanningScene& /*scene*/) {}
  /// A frame was fused into the map.
  virtual void map_changed(MapChange /*change*/) {}
  /// What to do with the arm at `q`. Foreground: the mission's clock pays for the work counted.
  virtual Decision decide(const Configuration& q, WorkMeter& work) = 0;
  /// So much mission time has passed since the last call.
  virtual void time_passes(double /*seconds*/) {}
  /// The next piece of background work; null: there is none at present.
  virtual std::unique_ptr<BackgroundTask> next_task() { return nullptr; }
  /// Takes over what a task that has run found; tasks made before the last frame too.
  virtual void finish_task(BackgroundTask& /*task*/, WorkMeter& /*work*/) {}
  /// Time passes, with background work worth `budget_s` by the cost table (a little more is charged
  /// to the next call).
  virtual void grow(double budget_s, WorkMeter& /*work*/) { time_passes(budget_s); }
  [[nodiscard]] virtual PlannerStatus status() const { return {}; }
  /// What it has in mind; empty: it does not say.
  [[nodiscard]] virtual PlanSketch sketch() const { return {}; }

  /// All that later calls depend on, as bytes (geometry/state_archive.h), between any two calls of
  /// a segment; tasks not finished are not in it.
  [[nodiscard]] virtual Expected<std::string> state() const {
    return fail("this planner cannot write its state");
  }
  /// In place of begin_segment, in the middle of a segment: goes on, to the bit, as the planner
  /// with the same options that wrote `state`. `scene` is that of the segment, its map as it was
  /// when the state was written. After an error begin_segment or another restore has to come first.
  [[nodiscard]] virtual Expected<void> restore(const PlanningScene& /*scene*/,
                                               std::string_view /*state*/) {
    return fail("this planner cannot go on from a state");
  }
};

}  // namespace canopeer
