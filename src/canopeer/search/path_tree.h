#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/search/cell_union.h"
#include "canopeer/search/view_path.h"

namespace canopeer {

/// The search tree over a view graph. Each node reached has its predecessor and the sums along the
/// path from the root to it. The set C(n) of cells visible along a path is never stored: it is
/// rebuilt from the views' own sets when a node is expanded. So memory grows with the graph, not
/// with the lengths of its paths.
class PathTree {
 public:
  /// Keeps a pointer to `graph`. Every node handed in must have its visible set.
  PathTree(const ViewGraph& graph, NodeId root);

  [[nodiscard]] bool reached(NodeId id) const { return entry(id).reached; }
  [[nodiscard]] NodeId root() const { return root_; }
  /// U(n) of eq. (1): |C|_unknown / L · (ROI + 1) / (t + 1); 0 at the root.
  [[nodiscard]] double utility(NodeId id) const { return entry(id).sums.utility; }
  /// t: view poses on the path to `id`, the root not counted.
  [[nodiscard]] int views(NodeId id) const { return entry(id).sums.views; }

  /// Makes `id`, a reached node, the one whose neighbours are evaluated next. Its C(n) is the union
  /// of the visible sets of all views on the path to it. The root's own set does not count (C = ∅
  /// there).
  void expand(NodeId id);
  /// U that `id` would have behind the expanded node, by an edge of `time_s`.
  [[nodiscard]] double utility_behind(NodeId id, double time_s) {
    return extend(id, time_s).utility;
  }
  /// Puts `id` behind the expanded node. `id` must be new to the tree.
  void attach(NodeId id, double time_s);
  /// Moves `id`, with all that hangs on it, behind the expanded node when that raises its utility
  /// and makes no circle. Returns whether it did.
  bool reattach_if_better(NodeId id, double time_s);

  [[nodiscard]] ViewPath path_to(NodeId id) const;

 private:
  struct Sums {
    std::int64_t unknown = 0;      ///< |C|_unknown
    std::int64_t new_unknown = 0;  ///< this view's part of it
    double time_s = 0.0;           ///< L(ψ)
    int roi_views = 0;             ///< ROI(ψ)
    int views = 0;                 ///< t
    double utility = 0.0;
  };
  struct Entry {
    bool reached = false;
    bool prepared = false;
    NodeId from{};
    double edge_time_s = 0.0;
    Sums sums;
    CellUnion::Prepared place;  ///< of what the view sees
    std::vector<NodeId> children;
  };
  [[nodiscard]] const Entry& entry(NodeId id) const {
    return entries_[static_cast<std::size_t>(id)];
  }
  Entry& entry(NodeId id) { return entries_[static_cast<std::size_t>(id)]; }
  /// What the view sees.
  [[nodiscard]] const VoxelSet& cells(NodeId id) const;
  const CellUnion::Prepared& place(NodeId id);
  /// Sums of `id` behind the expanded node.
  [[nodiscard]] Sums extend(NodeId id, double time_s);
  [[nodiscard]] bool on_path(NodeId id, NodeId end) const;
  void recompute_below(NodeId id);

  const ViewGraph* graph_;
  NodeId root_;
  NodeId expanded_;
  std::vector<Entry> entries_;
  CellUnion covered_;  ///< C of the expanded node
};

}  // namespace canopeer
