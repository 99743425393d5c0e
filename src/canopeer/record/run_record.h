#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// What a run was asked to do; the first line of a record.
struct RunHeader {
  std::string canopeer_version;
  std::string mission;  ///< name, e.g. "scenario_1"
  std::string planner;
  std::uint64_t seed = 1;
  std::string compute_table;
  int segments = 0;              ///< planned
  double segment_time_s = 60.0;  ///< 0: no limit
  double mission_time_s = 0.0;   ///< by a clock that never stops; 0: each segment has its own
  std::string settings_json;     ///< every effective option, as a JSON object in text
  std::string protocol{};        ///< name of the rules; empty: the mission's own
  int views_planned = 0;  ///< of all segments together, by a rule; 0: as many as there is time

  /// A segment ends by another rule than time.
  [[nodiscard]] bool without_time_limit() const {
    return segment_time_s <= 0.0 && mission_time_s <= 0.0;
  }
};

/// A segment of a mission: from when to when, and where it looks.
struct SegmentEvent {
  int segment = 0;   ///< 0 …
  std::string name;  ///< e.g. "stop 1, side 2"
  double start_s = 0.0;
  double end_s = 0.0;  ///< filled when the segment is over
  Box sampling_region_world;
  Box workspace_world;
};

/// A fruit as reported after a view; enough to score the run over time.
struct FruitSnapshot {
  int id = 0;
  Vec3 centre = Vec3::Zero();
  double volume_cm3 = 0.0;
  double confidence = 0.0;
};

/// Fruit pixels a detector found in a frame, against the labels the frame came with.
struct PixelHits {
  std::int64_t right = 0;
  std::int64_t wrong = 0;  ///< found where there is none
  std::int64_t missed = 0;

  // Of what was found the share that is right; of what is there the share that was found; of
  // either the share that is both. 1 where there is nothing to divide by.
  double precision() const { return share(right + wrong); }
  double recall() const { return share(right + missed); }
  double iou() const { return share(right + wrong + missed); }
  double share(std::int64_t whole) const {
    return whole == 0 ? 1.0 : static_cast<double>(right) / static_cast<double>(whole);
  }
};

/// One observation.
struct ViewEvent {
  int segment = 0;
  int view = 0;             ///< running number over the whole run, from 0
  double t_s = 0.0;         ///< when the frame was taken, mission time
  double planning_s = 0.0;  ///< standing still before the motion that led here
  double motion_s = 0.0;    ///< of the motion that led here
  std::vector<double> q;    ///< arm joints at the frame, rad
  Pose T_world_camera = Pose::Identity();
  std::string target_kind;               ///< "home", "roi", "occupied" or "border"
  std::optional<double> predicted_gain;  ///< distinct unknown voxels this view was expected to add
  std::int64_t realised_gain =
      0;  ///< voxels that were unknown before this frame and are known after it
  std::int64_t fused_points = 0;
  std::int64_t roi_voxels = 0;      ///< distinct ROI voxels in the map after the frame
  std::optional<PixelHits> pixels;  ///< nothing when frames come without labels
  int graph_nodes = 0;
  int graph_edges = 0;
  std::vector<FruitSnapshot> fruits;  ///< all fruits known after the frame
  /// Of the unknown voxels that the planner's rays (PathSearchOptions::fan) crossed from here just
  /// before the frame, those that are known after it; nothing where no gain was predicted.
  std::optional<std::int64_t> realised_in_fan{};
};

/// What became of frames that came on the way.
struct FrameCounts {
  int fused = 0;
  int late = 0;     ///< perception was busy
  int blurred = 0;  ///< more than was allowed
  int alike = 0;    ///< the camera had hardly moved since the last one
  int unread = 0;   ///< its images could not be read
};

/// One frame taken while the arm or the trolley moved, and fused.
struct FrameEvent {
  int segment = 0;
  int view = 0;                            ///< so many views were taken before it
  std::string during;                      ///< the kind of the motion: "view", "home", "trolley"
  double t_s = 0.0;                        ///< when it was taken, mission time
  Pose T_world_camera = Pose::Identity();  ///< as the robot said
  double blur_px = 0.0;  ///< how far its image moved during the exposure, where it moved fastest
  std::int64_t realised_gain = 0;  ///< as in ViewEvent
  std::int64_t fused_points = 0;
  std::optional<PixelHits> pixels;
  std::vector<FruitSnapshot> fruits;  ///< all fruits known after the frame
};

/// One motion of the arm or the trolley.
struct MotionEvent {
  std::string kind;  ///< "view", "home", "trolley"
  int segment = 0;
  double start_s = 0.0;
  double duration_s = 0.0;
  std::vector<std::vector<double>>
      waypoints;                   ///< arm joints, rad; straight lines in joint space between them
  std::vector<double> deviations;  ///< how far the path may pass each waypoint in an arc, Euclidean
                                   ///< joint distance; empty: it stops at each
  double joint_path_rad = 0.0;     ///< Σ|Δq| along it
  bool collision =
      false;  ///< with the robot itself, the structure, or what was mapped when it started
  bool plant_contact = false;     ///< with a part of a plant that was not mapped yet
  std::string ended = "arrived";  ///< or why not: "refused", "aborted", "cancelled", "preempted",
                                  ///< "stopped", "withheld"
  std::string why;                ///< in words
  std::vector<double> trolley{};  ///< of a drive: travel and lift where it ended, m
  std::optional<FrameCounts> frames{};    ///< on the way; nothing: none were wanted
  std::optional<double> camera_path_m{};  ///< how far the camera moved; nothing: not recorded
};

/// Sum of work done, e.g. {"candidates", 12345, 1.2}: count and simulated seconds charged for it.
struct WorkItem {
  std::string name;
  std::int64_t count = 0;
  double seconds = 0.0;
};

/// Where a mission's time went, s: all of it, nothing twice.
struct TimeSplit {
  double mapping_s = 0.0;      ///< standing still while frames are taken in
  double planning_s = 0.0;     ///< standing still while the planner decides
  double execution_s = 0.0;    ///< motions within segments; one under way at the end counts whole
  double waiting_s = 0.0;      ///< the planner had nothing to go for
  double transitions_s = 0.0;  ///< between segments: ways home, drives

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(mapping_s, planning_s, execution_s, waiting_s, transitions_s);
  }
};

/// What somebody told the mission to do.
struct SteeringEvent {
  double t_s = 0.0;
  int segment = 0;
  std::string said;  ///< "pause", "go_on", "next_segment", "wait_for_person", "stop"
  std::string by;    ///< who, e.g. "signal"
  std::string why;   ///< may be empty
};

/// Why a run ended early.
struct FaultEvent {
  double t_s = 0.0;
  std::string message;
};

/// A whole run in memory: what `record` holds on disk.
struct RunRecord {
  RunHeader header;
  std::vector<SegmentEvent> segments;
  std::vector<ViewEvent> views;
  std::vector<FrameEvent> frames;  ///< on the way
  std::vector<MotionEvent> motions;
  std::vector<SteeringEvent> steering;
  std::vector<FaultEvent> faults;
  std::vector<WorkItem> work;
  std::optional<TimeSplit> time{};  ///< nothing: not recorded, or the run was killed
  double end_s = 0.0;
  bool interrupted = false;
};

}  // namespace canopeer
