#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/viewgraph/view_pose.h"

// C++17-clean: who shows plans to people includes this.

namespace canopeer {

/// What a planner has in mind, for people who watch. Ids are the planner's own and stay the same
/// within a segment.
struct PlanSketch {
  /// A view of the graph, as others may draw it.
  struct View {
    Pose T_world_camera = Pose::Identity();  ///< optical frame
    TargetKind kind = TargetKind::none;      ///< what it looks at
    bool visited = false;
    std::int32_t id = 0;
  };
  /// A motion between two views, either way.
  struct Edge {
    std::int32_t a = 0;
    std::int32_t b = 0;
    double time_s = 0.0;
  };

  std::vector<View> views;         ///< ids ascend
  std::vector<Edge> edges;         ///< each once, with a < b
  std::vector<std::int32_t> path;  ///< views about to be taken, the next one first
  std::optional<std::int32_t> at;  ///< where the arm stands, or stood before the present motion
};

}  // namespace canopeer
