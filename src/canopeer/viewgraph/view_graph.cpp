#include "canopeer/viewgraph/view_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canopeer {

NodeId ViewGraph::add(ViewPose view) {
  nodes_.emplace_back();
  nodes_.back().view = std::move(view);
  ++live_nodes_;
  return static_cast<NodeId>(nodes_.size() - 1);
}

void ViewGraph::connect(NodeId a, NodeId b, double time_s) {
  if (a == b || edge_time(a, b)) return;
  node(a).edges.push_back({b, time_s});
  node(b).edges.push_back({a, time_s});
  ++edges_;
}

void ViewGraph::remove_edge(NodeId a, NodeId b) {
  if (!edge_time(a, b)) return;
  drop_half_edge(a, b);
  drop_half_edge(b, a);
  --edges_;
}

void ViewGraph::remove(NodeId id) {
  if (node(id).removed) return;
  while (!node(id).edges.empty()) remove_edge(id, node(id).edges.back().to);
  node(id).removed = true;
  node(id).cast.reset();
  --live_nodes_;
}

void ViewGraph::clear() {
  nodes_.clear();
  live_nodes_ = 0;
  edges_ = 0;
}

int ViewGraph::open_views(TargetKind kind) const {
  return static_cast<int>(std::count_if(nodes_.begin(), nodes_.end(), [kind](const ViewNode& n) {
    return n.view.kind == kind && !n.visited && !n.removed;
  }));
}

std::optional<double> ViewGraph::edge_time(NodeId a, NodeId b) const {
  for (const auto& edge : node(a).edges) {
    if (edge.to == b) return edge.time_s;
  }
  return std::nullopt;
}

void ViewGraph::drop_half_edge(NodeId from, NodeId to) {
  std::erase_if(node(from).edges, [to](const ViewEdge& edge) { return edge.to == to; });
}

std::vector<ViewGraph::Neighbor> ViewGraph::nearest(const Configuration& q, std::size_t k,
                                                    double max_distance_rad, NodeId except) const {
  return nearest_of(q, k, max_distance_rad, except, true);
}

std::vector<ViewGraph::Neighbor> ViewGraph::nearest_unvisited(const Configuration& q, std::size_t k,
                                                              double max_distance_rad,
                                                              NodeId except) const {
  return nearest_of(q, k, max_distance_rad, except, false);
}

std::vector<ViewGraph::Neighbor> ViewGraph::nearest_of(const Configuration& q, std::size_t k,
                                                       double max_distance_rad, NodeId except,
                                                       bool visited_too) const {
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto id = static_cast<NodeId>(i);
    if (nodes_[i].removed || id == except || (nodes_[i].visited && !visited_too)) continue;
    const double distance = joint_distance(q, nodes_[i].view.q);
    if (distance <= max_distance_rad) found.push_back({id, distance});
  }
  const auto nearer = [](const Neighbor& a, const Neighbor& b) {
    return std::pair(a.distance_rad, a.id) < std::pair(b.distance_rad, b.id);
  };
  const auto count = static_cast<std::ptrdiff_t>(std::min(k, found.size()));
  std::partial_sort(found.begin(), found.begin() + count, found.end(), nearer);
  found.resize(static_cast<std::size_t>(count));
  return found;
}

bool ViewGraph::has_similar(const ViewPose& view, const SimilarityLimits& limits) const {
  const double cos_limit = std::cos(limits.angle_rad);
  const double squared_limit = limits.position_m * limits.position_m;
  const Vec3 position = view.T_world_camera.translation();
  const Vec3 axis = view.T_world_camera.linear().col(2);
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const ViewNode& n) {
    return !n.removed &&
           (n.view.T_world_camera.translation() - position).squaredNorm() < squared_limit &&
           n.view.T_world_camera.linear().col(2).dot(axis) > cos_limit;
  });
}

void ViewGraph::invalidate_casts(const std::vector<BlockKey>& changed) {
  for (auto& n : nodes_) {
    if (n.cast && !still_valid(*n.cast, changed)) n.cast.reset();
  }
}

}  // namespace canopeer
