#include "canopeer/planner/nbs/beam_search.h"

#include <algorithm>
#include <optional>

#include "canopeer/search/cell_union.h"

namespace canopeer {
namespace {

using PathIndex = std::size_t;
constexpr PathIndex kNoPath = static_cast<PathIndex>(-1);

/// A path from the start, by its last view and the path before it.
struct PartialPath {
  NodeId node{};
  PathIndex before = kNoPath;
  std::int64_t added = 0;  ///< m of the last view
  double edge_time_s = 0.0;
  double time_s = 0.0;
  double gain = 0.0;      ///< g
  double expected = 0.0;  ///< q
  int views = 0;
  bool dropped = false;  ///< no beam holds it any more
  bool greedy = false;   ///< held in any case
};

/// A view a path could take next.
struct NextView {
  NodeId node{};
  double edge_time_s = 0.0;
  std::int64_t added = 0;
  [[nodiscard]] double rate() const {
    return static_cast<double>(added) / std::max(edge_time_s, 1e-6);
  }
};

class BeamSearch {
 public:
  BeamSearch(ViewGraph& graph, NodeId start, const VoxelMap& map, const PathSearchOptions& views,
             const NbsOptions& options, double horizon_s, WorkMeter& work)
      : graph_(graph),
        map_(map),
        views_(views),
        options_(options),
        horizon_s_(horizon_s),
        work_(work),
        beams_(graph.id_count()),
        prepared_(graph.id_count()) {
    PartialPath root;
    root.node = start;
    root.greedy = true;
    paths_.push_back(root);
  }

  ViewPath run() {
    const int width = std::max(1, options_.max_expansions / std::max(1, options_.max_views));
    std::vector<PathIndex> layer = {0};
    for (int views = 0; views < options_.max_views && !layer.empty(); ++views) {
      std::vector<PathIndex> next;
      for (const PathIndex p : best_of(std::move(layer), width)) extend(p, next);
      layer = std::move(next);
    }
    return path_to(best());
  }

 private:
  /// The paths of a layer that are still held, the most promising first, `width` at most; the
  /// greedy one first of all.
  std::vector<PathIndex> best_of(std::vector<PathIndex> layer, int width) const {
    std::erase_if(layer, [&](PathIndex p) { return paths_[p].dropped; });
    std::stable_sort(layer.begin(), layer.end(), [&](PathIndex a, PathIndex b) {
      if (paths_[a].greedy != paths_[b].greedy) return paths_[a].greedy;
      return paths_[a].expected > paths_[b].expected;
    });
    if (layer.size() > static_cast<std::size_t>(width))
      layer.resize(static_cast<std::size_t>(width));
    return layer;
  }

  /// Offers every view that could come next to the beam of its node; the path's own q is then
  /// known. New paths go to `next`.
  void extend(PathIndex p, std::vector<PathIndex>& next) {
    if (paths_[p].dropped) return;  // pushed out by one of its own layer
    const std::vector<NextView> frontier = frontier_of(p);
    paths_[p].expected = expected(paths_[p], best_rate(frontier, std::nullopt));
    const NextView* greedy = nullptr;
    for (const NextView& view : frontier) {
      if (greedy == nullptr || view.rate() > greedy->rate()) greedy = &view;
    }
    for (const NextView& view : frontier) {
      PartialPath path = step(p, view);
      path.expected = expected(path, best_rate(frontier, view.node));
      path.greedy = paths_[p].greedy && &view == greedy;
      if (offer(path)) next.push_back(paths_.size() - 1);
    }
  }

  /// The unvisited views next to the path's end that are not on it and fit into the horizon, with
  /// what each would add.
  std::vector<NextView> frontier_of(PathIndex p) {
    std::vector<NextView> frontier;
    std::vector<NodeId> nodes;
    const PartialPath& path = paths_[p];
    for (const ViewEdge& edge : graph_.node(path.node).edges) {
      const double time_s = edge.time_s + views_.observe_s;
      if (graph_.node(edge.to).visited || on_path(edge.to, p)) continue;
      if (path.time_s + time_s > horizon_s_) continue;
      frontier.push_back({edge.to, time_s, 0});
      nodes.push_back(edge.to);
    }
    ensure_casts(graph_, nodes, map_, views_.fan, work_, views_.cast);
    work_.add(Work::expansion, static_cast<std::int64_t>(frontier.size()));
    covered_.clear();
    for (PathIndex i = p; paths_[i].before != kNoPath; i = paths_[i].before) {
      covered_.add(cells(paths_[i].node), place(paths_[i].node));
    }
    for (NextView& view : frontier) {
      view.added = covered_.count_new(cells(view.node), place(view.node));
    }
    return frontier;
  }

  /// ρ: the highest m/Δt, `but` left out.
  static double best_rate(const std::vector<NextView>& frontier, std::optional<NodeId> but) {
    double best = 0.0;
    for (const NextView& view : frontier) {
      if (view.node != but) best = std::max(best, view.rate());
    }
    return best;
  }

  PartialPath step(PathIndex p, const NextView& view) const {
    const PartialPath& from = paths_[p];
    PartialPath path;
    path.node = view.node;
    path.before = p;
    path.added = view.added;
    path.edge_time_s = view.edge_time_s;
    path.time_s = from.time_s + view.edge_time_s;
    path.gain = from.gain + static_cast<double>(view.added) * weight(path.time_s);
    path.views = from.views + 1;
    return path;
  }

  [[nodiscard]] double weight(double time_s) const {
    return options_.early ? 1.0 - time_s / horizon_s_ : 1.0;
  }
  [[nodiscard]] double expected(const PartialPath& path, double rate) const {
    const double mean_weight = options_.early ? 0.5 * weight(path.time_s) : 1.0;
    return path.gain + options_.promise * rate * (horizon_s_ - path.time_s) * mean_weight;
  }

  /// Takes the path when its node's beam has room or holds a worse one, which is dropped then.
  bool offer(const PartialPath& path) {
    auto& beam = beams_[static_cast<std::size_t>(path.node)];
    if (beam.size() >= static_cast<std::size_t>(options_.beam)) {
      const auto worst = std::min_element(beam.begin(), beam.end(), [&](PathIndex a, PathIndex b) {
        return paths_[a].expected < paths_[b].expected;
      });
      if (!path.greedy && paths_[*worst].expected >= path.expected) return false;
      paths_[*worst].dropped = !paths_[*worst].greedy;
      beam.erase(worst);
    }
    beam.push_back(paths_.size());
    paths_.push_back(path);
    return true;
  }

  /// The highest q; of equal ones the first.
  [[nodiscard]] PathIndex best() const {
    PathIndex best = 0;
    for (PathIndex p = 1; p < paths_.size(); ++p) {
      if (best == 0 || paths_[p].expected > paths_[best].expected) best = p;
    }
    return best;
  }

  [[nodiscard]] ViewPath path_to(PathIndex end) const {
    ViewPath path;
    path.utility = paths_[end].gain;
    for (PathIndex i = end; paths_[i].before != kNoPath; i = paths_[i].before) {
      path.steps.push_back({paths_[i].node, paths_[i].edge_time_s, paths_[i].added});
    }
    std::reverse(path.steps.begin(), path.steps.end());
    return path;
  }

  [[nodiscard]] bool on_path(NodeId id, PathIndex end) const {
    for (PathIndex i = end; i != kNoPath; i = paths_[i].before) {
      if (paths_[i].node == id) return true;
    }
    return false;
  }
  [[nodiscard]] const VoxelSet& cells(NodeId id) const { return graph_.node(id).cast->unknown; }
  const CellUnion::Prepared& place(NodeId id) {
    auto& known = prepared_[static_cast<std::size_t>(id)];
    if (!known) known = covered_.prepare(cells(id));
    return *known;
  }

  ViewGraph& graph_;
  const VoxelMap& map_;
  const PathSearchOptions& views_;
  const NbsOptions& options_;
  double horizon_s_;
  WorkMeter& work_;
  std::vector<PartialPath> paths_;
  std::vector<std::vector<PathIndex>> beams_;                 // by node
  std::vector<std::optional<CellUnion::Prepared>> prepared_;  // by node
  CellUnion covered_;
};

}  // namespace

ViewPath search_beams(ViewGraph& graph, NodeId start, const VoxelMap& map,
                      const PathSearchOptions& views, const NbsOptions& options, double horizon_s,
                      WorkMeter& work) {
  return BeamSearch(graph, start, map, views, options, horizon_s, work).run();
}

}  // namespace canopeer
