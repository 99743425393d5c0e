#include "canopeer/search/random_walk.h"

#include <algorithm>

namespace canopeer {

ViewPath random_walk(const ViewGraph& graph, NodeId start, int views, Rng& rng) {
  ViewPath path;
  NodeId at = start;
  for (int i = 0; i < views; ++i) {
    std::vector<ViewEdge> ways;
    for (const auto& edge : graph.node(at).edges) {
      const bool on_path = std::any_of(path.steps.begin(), path.steps.end(),
                                       [&](const PathStep& step) { return step.node == edge.to; });
      if (!on_path && !graph.node(edge.to).visited) ways.push_back(edge);
    }
    if (ways.empty()) break;
    const ViewEdge& way = ways[rng.index(ways.size())];
    path.steps.push_back({way.to, way.time_s, 0});
    at = way.to;
  }
  return path;
}

}  // namespace canopeer
