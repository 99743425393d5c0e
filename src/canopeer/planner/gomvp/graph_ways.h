#pragma once

#include <limits>
#include <vector>

#include "canopeer/viewgraph/view_graph.h"

namespace canopeer {

/// The quickest ways over the graph from one view to all others, standing still for `observe_s` at
/// each view they lead to. Dijkstra's algorithm; ties go to the older view.
class GraphWays {
 public:
  static constexpr double kNoWay = std::numeric_limits<double>::infinity();

  GraphWays(const ViewGraph& graph, NodeId from, double observe_s);

  /// kNoWay: not to be reached.
  [[nodiscard]] double time_s(NodeId to) const { return time_s_[static_cast<std::size_t>(to)]; }
  /// The views of the way to a view that is to be reached, without the first.
  [[nodiscard]] std::vector<NodeId> way(NodeId to) const;

 private:
  NodeId from_;
  std::vector<double> time_s_;
  std::vector<NodeId> before_;
};

}  // namespace canopeer
