#include "canopeer/search/path_search.h"

#include <queue>
#include <utility>

#include "canopeer/search/path_tree.h"
#include "canopeer/search/view_casts.h"

namespace canopeer {
namespace {

struct HighestUtilityFirst {
  double utility = 0.0;
  NodeId id{};
  // Highest utility first, then the older node.
  friend bool operator<(const HighestUtilityFirst& a, const HighestUtilityFirst& b) {
    return std::pair(a.utility, b.id) < std::pair(b.utility, a.id);
  }
};

std::vector<NodeId> unvisited_neighbors(const ViewGraph& graph, NodeId id) {
  std::vector<NodeId> ids;
  for (const auto& edge : graph.node(id).edges) {
    if (!graph.node(edge.to).visited) ids.push_back(edge.to);
  }
  return ids;
}

}  // namespace

ViewPath search_path(ViewGraph& graph, NodeId start, const VoxelMap& map,
                     const PathSearchOptions& options, WorkMeter& work) {
  PathTree tree(graph, start);
  std::vector<bool> expanded(graph.id_count(), false);
  std::priority_queue<HighestUtilityFirst> queue;
  queue.push({0.0, start});
  NodeId best = start;
  for (int n = 0; n < options.max_expansions && !queue.empty();) {
    const auto [utility, id] = queue.top();
    queue.pop();
    // A node that was given a better predecessor stands in the queue twice; it is expanded once.
    if (expanded[static_cast<std::size_t>(id)]) continue;
    expanded[static_cast<std::size_t>(id)] = true;
    ++n;
    if (tree.views(id) >= options.max_views) continue;

    const auto neighbors = unvisited_neighbors(graph, id);
    ensure_casts(graph, neighbors, map, options.fan, work, options.cast);
    tree.expand(id);  // C(n)
    work.add(Work::expansion, static_cast<std::int64_t>(neighbors.size()));
    for (const NodeId next : neighbors) {
      const double time_s = *graph.edge_time(id, next) + options.observe_s;
      if (!tree.reached(next)) {
        tree.attach(next, time_s);
      } else if (!options.reparent || !tree.reattach_if_better(next, time_s)) {
        continue;
      }
      queue.push({tree.utility(next), next});
    }
  }
  // Moving a subtree changes utilities below it, so the best node is looked for at the end.
  for (std::size_t i = 0; i < graph.id_count(); ++i) {
    const auto id = static_cast<NodeId>(i);
    if (tree.reached(id) && tree.utility(id) > tree.utility(best)) best = id;
  }
  return tree.path_to(best);
}

}  // namespace canopeer
