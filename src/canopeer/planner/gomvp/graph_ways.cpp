#include "canopeer/planner/gomvp/graph_ways.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace canopeer {

GraphWays::GraphWays(const ViewGraph& graph, NodeId from, double observe_s)
    : from_(from), time_s_(graph.id_count(), kNoWay), before_(graph.id_count(), from) {
  using Reached = std::pair<double, NodeId>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  time_s_[static_cast<std::size_t>(from)] = 0.0;
  open.push({0.0, from});
  while (!open.empty()) {
    const auto [time_s, at] = open.top();
    open.pop();
    if (time_s > time_s_[static_cast<std::size_t>(at)]) continue;
    for (const ViewEdge& edge : graph.node(at).edges) {
      const double then_s = time_s + edge.time_s + observe_s;
      const auto to = static_cast<std::size_t>(edge.to);
      if (then_s >= time_s_[to]) continue;
      time_s_[to] = then_s;
      before_[to] = at;
      open.push({then_s, edge.to});
    }
  }
}

std::vector<NodeId> GraphWays::way(NodeId to) const {
  std::vector<NodeId> nodes;
  for (NodeId at = to; at != from_; at = before_[static_cast<std::size_t>(at)]) nodes.push_back(at);
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace canopeer
