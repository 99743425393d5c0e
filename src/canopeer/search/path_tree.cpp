#include "canopeer/search/path_tree.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {

PathTree::PathTree(const ViewGraph& graph, NodeId root)
    : graph_(&graph), root_(root), expanded_(root), entries_(graph.id_count()) {
  entry(root).reached = true;
}

void PathTree::expand(NodeId id) {
  CANOPEER_CHECK(reached(id), "only a reached node has a path");
  covered_.clear();
  for (NodeId n = id; n != root_; n = entry(n).from) covered_.add(cells(n), place(n));
  expanded_ = id;
}

const VoxelSet& PathTree::cells(NodeId id) const { return graph_->node(id).cast->unknown; }

const CellUnion::Prepared& PathTree::place(NodeId id) {
  Entry& e = entry(id);
  if (!e.prepared) e.place = covered_.prepare(cells(id));
  e.prepared = true;
  return e.place;
}

PathTree::Sums PathTree::extend(NodeId id, double time_s) {
  Sums sums = entry(expanded_).sums;
  sums.new_unknown = covered_.count_new(cells(id), place(id));
  sums.unknown += sums.new_unknown;
  sums.time_s += time_s;
  sums.roi_views += graph_->node(id).view.kind == TargetKind::roi ? 1 : 0;
  sums.views += 1;
  // U(n), eq. (1) of [Zaenker23]
  sums.utility =
      static_cast<double>(sums.unknown) / sums.time_s * (sums.roi_views + 1) / (sums.views + 1);
  return sums;
}

void PathTree::attach(NodeId id, double time_s) {
  CANOPEER_CHECK(!reached(id), "attach a new node");
  Entry& e = entry(id);
  e.sums = extend(id, time_s);
  e.reached = true;
  e.from = expanded_;
  e.edge_time_s = time_s;
  entry(expanded_).children.push_back(id);
}

bool PathTree::reattach_if_better(NodeId id, double time_s) {
  const NodeId from = expanded_;
  if (id == root_ || entry(id).from == from || on_path(id, from)) return false;
  const Sums sums = extend(id, time_s);
  if (sums.utility <= entry(id).sums.utility) return false;
  std::erase(entry(entry(id).from).children, id);
  entry(from).children.push_back(id);
  Entry& e = entry(id);
  e.from = from;
  e.edge_time_s = time_s;
  e.sums = sums;
  if (!e.children.empty()) {
    recompute_below(id);
    expand(from);
  }
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
  expand(id);
  for (const NodeId child : entry(id).children) {
    entry(child).sums = extend(child, entry(child).edge_time_s);
  }
  for (const NodeId child : entry(id).children) recompute_below(child);
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
