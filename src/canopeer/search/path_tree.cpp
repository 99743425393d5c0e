#include "canopeer/search/path_tree.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {

PathTree::PathTree(const ViewGraph& graph, NodeId root)
    : graph_(&graph), root_(root), entries_(graph.id_count()) {
  entry(root).reached = true;
}

VoxelSet PathTree::covered(NodeId id) const {
  VoxelSet cells;
  for (NodeId n = id; n != root_; n = entry(n).from) cells.merge(graph_->node(n).cast->unknown);
  return cells;
}

PathTree::Sums PathTree::extend(const Sums& base, NodeId id, double time_s,
                                const VoxelSet& covered) const {
  Sums sums = base;
  sums.new_unknown = covered.count_new(graph_->node(id).cast->unknown);
  sums.unknown += sums.new_unknown;
  sums.time_s += time_s;
  sums.roi_views += graph_->node(id).view.kind == TargetKind::roi ? 1 : 0;
  sums.views += 1;
  // U(n), eq. (1) of [Zaenker23]
  sums.utility =
      static_cast<double>(sums.unknown) / sums.time_s * (sums.roi_views + 1) / (sums.views + 1);
  return sums;
}

void PathTree::attach(NodeId id, NodeId from, double time_s, const VoxelSet& covered_from) {
  CANOPEER_CHECK(!reached(id) && reached(from), "attach a new node behind a reached one");
  Entry& e = entry(id);
  e.reached = true;
  e.from = from;
  e.edge_time_s = time_s;
  e.sums = extend(entry(from).sums, id, time_s, covered_from);
  entry(from).children.push_back(id);
}

bool PathTree::reattach_if_better(NodeId id, NodeId from, double time_s,
                                  const VoxelSet& covered_from) {
  if (id == root_ || entry(id).from == from || on_path(id, from)) return false;
  const Sums sums = extend(entry(from).sums, id, time_s, covered_from);
  if (sums.utility <= entry(id).sums.utility) return false;
  std::erase(entry(entry(id).from).children, id);
  entry(from).children.push_back(id);
  Entry& e = entry(id);
  e.from = from;
  e.edge_time_s = time_s;
  e.sums = sums;
  recompute_below(id);
  return true;
}

bool PathTree::on_path(NodeId id, NodeId end) const {
  for (NodeId n = end; n != root_; n = entry(n).from) {
    if (n == id) return true;
  }
  return id == root_;
}

void PathTree::recompute_below(NodeId id) {
  if (entry(id).children.empty()) return;
  const VoxelSet cells = covered(id);
  for (const NodeId child : entry(id).children) {
    entry(child).sums = extend(entry(id).sums, child, entry(child).edge_time_s, cells);
    recompute_below(child);
  }
}

ViewPath PathTree::path_to(NodeId id) const {
  ViewPath path;
  path.utility = utility(id);
  for (NodeId n = id; n != root_; n = entry(n).from) {
    path.steps.push_back({n, entry(n).edge_time_s, entry(n).sums.new_unknown});
  }
  std::reverse(path.steps.begin(), path.steps.end());
  return path;
}

}  // namespace canopeer
