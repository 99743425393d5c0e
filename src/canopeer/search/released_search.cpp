#include "canopeer/search/released_search.h"

#include <algorithm>
#include <queue>
#include <utility>
#include <vector>

#include "canopeer/map/voxel_union.h"
#include "canopeer/search/view_casts.h"

namespace canopeer {
namespace {

/// What is known of a node that was reached.
struct Reached {
  bool reached = false;
  bool expanded = false;
  NodeId from{};
  double cost_rad = 0.0;
  double edge_time_s = 0.0;
  std::int64_t unknown = 0;
  std::int64_t new_unknown = 0;
  int roi_views = 0;
  int views = 0;
  double gain = 0.0;
};

struct CheapestFirst {
  double cost_rad = 0.0;
  NodeId id{};
  // Lowest cost first, then the older node.
  friend bool operator<(const CheapestFirst& a, const CheapestFirst& b) {
    return std::pair(a.cost_rad, a.id) > std::pair(b.cost_rad, b.id);
  }
};

class ReleasedSearch {
 public:
  ReleasedSearch(ViewGraph& graph, NodeId start) : graph_(graph), start_(start) {
    nodes_.resize(graph.id_count());
    at(start).reached = true;
    queue_.push({0.0, start});
  }

  [[nodiscard]] bool done() const { return queue_.empty(); }

  void expand_next(const VoxelMap& map, const ViewFan& fan, WorkMeter& work) {
    const NodeId id = queue_.top().id;
    queue_.pop();
    if (std::exchange(at(id).expanded, true)) return;
    cover_path(id);
    for (const auto& edge : graph_.node(id).edges) {
      if (graph_.node(edge.to).visited || at(edge.to).reached) continue;
      ensure_casts(graph_, {edge.to}, map, fan, work);
      work.add(Work::expansion);
      reach(edge, id);
    }
  }

  [[nodiscard]] ViewPath best_path() const {
    NodeId best = start_;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const auto id = static_cast<NodeId>(i);
      if (nodes_[i].reached && nodes_[i].gain > at(best).gain) best = id;
    }
    ViewPath path;
    path.utility = at(best).gain;
    for (NodeId n = best; n != start_; n = at(n).from) {
      path.steps.push_back({n, at(n).edge_time_s, at(n).new_unknown});
    }
    std::reverse(path.steps.begin(), path.steps.end());
    return path;
  }

 private:
  [[nodiscard]] const Reached& at(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  Reached& at(NodeId id) { return nodes_[static_cast<std::size_t>(id)]; }

  void cover_path(NodeId id) {
    covered_.clear();
    for (NodeId n = id; n != start_; n = at(n).from) {
      covered_.add(graph_.node(n).cast->unknown);
    }
  }

  void reach(const ViewEdge& edge, NodeId from) {
    const ViewNode& node = graph_.node(edge.to);
    Reached r = at(from);
    r.expanded = false;
    r.from = from;
    r.cost_rad += graph_.distance_rad(from, edge.to);
    r.edge_time_s = edge.time_s;
    r.new_unknown = covered_.count_new(node.cast->unknown);
    r.unknown += r.new_unknown;
    r.roi_views += node.view.kind == TargetKind::roi ? 1 : 0;
    r.views += 1;
    r.gain = static_cast<double>(r.unknown) * (r.roi_views + 1) / (r.views + 1);
    at(edge.to) = r;
    queue_.push({at(edge.to).cost_rad, edge.to});
  }

  ViewGraph& graph_;
  NodeId start_;
  std::vector<Reached> nodes_;
  std::priority_queue<CheapestFirst> queue_;
  VoxelUnion covered_;
};

}  // namespace

ViewPath search_released(ViewGraph& graph, NodeId start, const VoxelMap& map,
                         const ReleasedSearchOptions& options, const CostTable& costs,
                         WorkMeter& work) {
  for (std::size_t i = 0; i < graph.id_count(); ++i)
    graph.node(static_cast<NodeId>(i)).cast.reset();
  const double begin_s = work.seconds(costs);
  ReleasedSearch search(graph, start);
  while (!search.done()) {
    const bool late =
        options.time_limit_s > 0.0 && work.seconds(costs) - begin_s > options.time_limit_s;
    if (late) break;
    search.expand_next(map, options.fan, work);
  }
  return search.best_path();
}

}  // namespace canopeer
