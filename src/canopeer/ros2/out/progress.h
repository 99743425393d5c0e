#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/diagnostic_msgs.h"
#include "canopeer/mission/event.h"

namespace canopeer::ros {

/// How far a mission is, put together from its events.
class Progress {
 public:
  void add(const Event& event);
  void add_loss(std::int64_t events) { lost_events_ += events; }

  /// One JSON object (docs/formats.md): state, mission time, segment, views, fruits, map, plan,
  /// last motion.
  [[nodiscard]] std::string json() const;
  /// "NODE: mission", "NODE: arm", "NODE: camera", "NODE: map".
  [[nodiscard]] std::vector<diagnostic_msgs::DiagnosticStatus> diagnostics(
      const std::string& node) const;

 private:
  enum class State { waiting, working, moving, paused, waiting_for_person, ended, failed };
  [[nodiscard]] static const char* name_of(State state);

  State state_ = State::waiting;
  double t_s_ = 0.0;
  int segments_ = 0;
  double segment_time_s_ = 0.0;
  SegmentEvent segment_;
  bool interrupted_ = false;
  std::string why_;  // of a hold or a failure
  int views_ = 0;
  double last_view_s_ = 0.0;
  std::int64_t fused_points_ = 0;
  std::int64_t roi_voxels_ = 0;
  int graph_nodes_ = 0;
  int graph_edges_ = 0;
  int fruits_ = 0;
  int motions_ = 0;
  int missed_motions_ = 0;
  MotionEvent motion_;  // the last one
  std::int64_t lost_events_ = 0;
};

}  // namespace canopeer::ros
