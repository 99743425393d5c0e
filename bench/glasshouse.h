#pragma once

#include <string>
#include <vector>

#include "canopeer/viewgraph/view_graph.h"
#include "canopeer/viewgraph/view_sampler.h"
#include "support/first_stop.h"

namespace canopeer {

// A robot at its first stop after `views` frames, the first at home, the others at valid view
// poses: what planning works with.
class Glasshouse : public test::FirstStop {
 public:
  explicit Glasshouse(const std::string& robot_yaml, int views = 5);

  FrontierTargets targets;

  /// Valid view poses drawn as the planner does.
  [[nodiscard]] std::vector<ViewPose> draw_views(int candidates, std::uint64_t seed) const;

  /// Camera positions and targets in the arm base frame as the sampler draws them, before anything
  /// is known of reach or collisions: a mix of reachable and unreachable views.
  struct Sight {
    Vec3 position_base;
    Vec3 target_base;
  };
  [[nodiscard]] std::vector<Sight> draw_sights(int count, std::uint64_t seed) const;

  /// The motions that GraphBuilder::grow would have checked while a graph of `nodes` views grows.
  struct Edge {
    Configuration from;
    Configuration to;
  };
  [[nodiscard]] std::vector<Edge> proposed_edges(int nodes, std::uint64_t seed) const;
};

}  // namespace canopeer
