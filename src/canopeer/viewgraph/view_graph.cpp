#include "canopeer/viewgraph/view_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canopeer {

NodeId ViewGraph::add(ViewPose view) {
  nodes_.emplace_back();
  index(view);
  nodes_.back().view = std::move(view);
  ++live_nodes_;
  return static_cast<NodeId>(nodes_.size() - 1);
}

void ViewGraph::index(const ViewPose& view) {
  q_.insert(q_.end(), view.q.begin(), view.q.end());
  positions_.emplace_back(view.T_world_camera.translation());
  axes_.emplace_back(view.T_world_camera.linear().col(2));
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
  q_.clear();
  positions_.clear();
  axes_.clear();
  live_nodes_ = 0;
  edges_ = 0;
}

void ViewGraph::count_and_index() {
  std::size_t half_edges = 0;
  for (const ViewNode& n : nodes_) {
    index(n.view);
    live_nodes_ += n.removed ? 0 : 1;
    half_edges += n.edges.size();
  }
  edges_ = static_cast<int>(half_edges / 2);
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
  const auto dof = static_cast<std::size_t>(q.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double distance = endless_.distance(&q_[i * dof], q);
    if (distance > max_distance_rad) continue;
    const auto id = static_cast<NodeId>(i);
    if (nodes_[i].removed || id == except || (nodes_[i].visited && !visited_too)) continue;
    found.push_back({id, distance});
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
  if (limits.published_below > 0.0) return has_similar_as_published(view, limits.published_below);
  const double cos_limit = std::cos(limits.angle_rad);
  const double squared_limit = limits.position_m * limits.position_m;
  const Vec3 position = view.T_world_camera.translation();
  const Vec3 axis = view.T_world_camera.linear().col(2);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if ((positions_[i] - position).squaredNorm() < squared_limit &&
        axes_[i].dot(axis) > cos_limit && !nodes_[i].removed) {
      return true;
    }
  }
  return false;
}

bool ViewGraph::has_similar_as_published(const ViewPose& view, double below) const {
  const Vec3 axis = view.T_world_camera.linear().col(2);
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const ViewNode& n) {
    if (n.removed || n.view.kind == TargetKind::none) return false;
    const double distance = (n.view.target_world - view.target_world).norm() / 0.1;
    return distance * (1.0 - n.view.T_world_camera.linear().col(2).dot(axis)) < below;
  });
}

void ViewGraph::invalidate_casts(const std::vector<BlockKey>& changed) {
  for (auto& n : nodes_) {
    if (n.cast && !still_valid(*n.cast, changed)) n.cast.reset();
  }
}

std::vector<NodeId> ViewGraph::with_casts() const {
  std::vector<NodeId> ids;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].cast) ids.push_back(static_cast<NodeId>(i));
  }
  return ids;
}

}  // namespace canopeer
