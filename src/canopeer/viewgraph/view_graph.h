#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/map/view_cast.h"
#include "canopeer/viewgraph/view_pose.h"

namespace canopeer {

/// Names a node of one ViewGraph; stays valid until the graph is cleared.
enum class NodeId : std::uint32_t {};

/// A motion of the arm from one view to another.
struct ViewEdge {
  NodeId to{};
  double time_s = 0.0;  ///< execution time of the straight joint motion

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(to, time_s);
  }
};

/// A view of the graph, and the motions that begin there.
struct ViewNode {
  ViewPose view;
  std::vector<ViewEdge> edges;
  bool visited = false;  ///< observed already: never a goal again
  bool removed = false;  ///< taken out; has no edges
  std::optional<ViewCast>
      cast;  ///< what the view would see; nothing when not computed or out of date

  /// Without the cast, which follows from the map.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(view, edges, visited, removed);
  }
};

/// Views nearer to each other than both limits are one view.
struct SimilarityLimits {
  double position_m = 0.04;
  double angle_rad = 0.15;  ///< between the optical axes
  /// The published measure instead, no metric. Similar when (distance of the targets / 0.1 m) · (1
  /// − cos of the angle between the axes) is below this; 0: not used.
  double published_below = 0.0;
};

/// The graph of reachable view poses and the collision-free timed motions between them
/// ([Zaenker23], section III-C). Edges go both ways and take the same time. Not thread-safe for
/// writing.
class ViewGraph {
 public:
  /// Joints that turn without end count the shorter way round; none by default.
  void set_endless(const EndlessJoints& endless) { endless_ = endless; }

  NodeId add(ViewPose view);
  /// An edge both ways; nothing happens when it is there already.
  void connect(NodeId a, NodeId b, double time_s);
  void remove_edge(NodeId a, NodeId b);
  /// Takes the node and its edges out.
  void remove(NodeId id);
  void clear();

  [[nodiscard]] const ViewNode& node(NodeId id) const {
    return nodes_[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] ViewNode& node(NodeId id) { return nodes_[static_cast<std::size_t>(id)]; }
  /// Ids ever given, removed nodes included: valid ids are 0 … id_count() − 1.
  [[nodiscard]] std::size_t id_count() const { return nodes_.size(); }
  [[nodiscard]] int node_count() const { return live_nodes_; }
  /// Views of a kind not visited yet.
  [[nodiscard]] int open_views(TargetKind kind) const;
  [[nodiscard]] int edge_count() const { return edges_; }
  [[nodiscard]] std::optional<double> edge_time(NodeId a, NodeId b) const;
  /// Σ|Δq| between two views, rad.
  [[nodiscard]] double distance_rad(NodeId a, NodeId b) const {
    return endless_.distance(node(a).view.q, node(b).view.q);
  }

  /// A node, and how far it is.
  struct Neighbor {
    NodeId id{};
    double distance_rad = 0.0;  ///< L1 in joint space
  };
  /// The k nearest nodes within `max_distance_rad` (Σ|Δq|), nearest first, ties by id; `except` is
  /// left out.
  [[nodiscard]] std::vector<Neighbor> nearest(const Configuration& q, std::size_t k,
                                              double max_distance_rad, NodeId except) const;
  /// The same among the nodes not visited yet.
  [[nodiscard]] std::vector<Neighbor> nearest_unvisited(const Configuration& q, std::size_t k,
                                                        double max_distance_rad,
                                                        NodeId except) const;
  /// True when a node stands and looks almost like `view`.
  [[nodiscard]] bool has_similar(const ViewPose& view, const SimilarityLimits& limits) const;

  /// Forgets what every view touched by the changed blocks was expected to see.
  void invalidate_casts(const std::vector<BlockKey>& changed);
  /// The views of which is known what they would see.
  [[nodiscard]] std::vector<NodeId> with_casts() const;

  template <typename Archive>
  void save(Archive& archive) const {
    archive(nodes_);
  }
  template <typename Archive>
  void load(Archive& archive) {
    clear();
    archive(nodes_);
    count_and_index();
  }

 private:
  /// Brings all that follows from the nodes up to date.
  void count_and_index();
  void index(const ViewPose& view);
  [[nodiscard]] std::vector<Neighbor> nearest_of(const Configuration& q, std::size_t k,
                                                 double max_distance_rad, NodeId except,
                                                 bool visited_too) const;
  void drop_half_edge(NodeId from, NodeId to);
  [[nodiscard]] bool has_similar_as_published(const ViewPose& view, double below) const;

  EndlessJoints endless_;
  std::vector<ViewNode> nodes_;
  // Searched from end to end for every candidate, so they lie close together; by node.
  std::vector<double> q_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> axes_;
  int live_nodes_ = 0;
  int edges_ = 0;
};

}  // namespace canopeer
