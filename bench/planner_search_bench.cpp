// Search expansions with and without view casts inside, beside the published way (sets of octree
// keys, copied along the path).

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench_threads.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/search/path_tree.h"
#include "canopeer/search/random_walk.h"
#include "canopeer/search/view_casts.h"
#include "planner_segment.h"

namespace canopeer {
namespace {

constexpr int kGraphNodes = 2000;
constexpr int kPathLength = 10;
constexpr int kPaths = 64;
const ViewFan kFan{.columns = 9, .rows = 7};  // the published code's 63 rays

/// A full graph with all view casts in place, and a search tree over it that reaches as far as
/// paths of ten views.
struct Search {
  Built built{kGraphNodes};
  std::vector<std::pair<NodeId, NodeId>> grown;  // node and predecessor, in order
  std::vector<NodeId> ends;                      // the tree's nodes ten views from the root

  Search() {
    while (!built.builder->resting()) built.grow();
    for (std::size_t i = 0; i < built.graph.id_count(); ++i) {
      ViewNode& node = built.graph.node(static_cast<NodeId>(i));
      if (!node.removed) node.cast = cast_view(segment().map(), node.view.T_world_camera, kFan);
    }
    // Walks from the root: where one comes to a node of the tree it goes on from there.
    Rng rng(3, "bench paths");
    std::vector<NodeId> from(built.graph.id_count());
    std::vector<int> depth(built.graph.id_count(), -1);
    depth[static_cast<std::size_t>(built.start)] = 0;
    for (int walks = 0; walks < 100000 && ends.size() < kPaths; ++walks) {
      NodeId at = built.start;
      for (const auto& step : random_walk(built.graph, built.start, kPathLength, rng).steps) {
        const auto next = static_cast<std::size_t>(step.node);
        const int here = depth[static_cast<std::size_t>(at)];
        if (depth[next] < 0 && here == kPathLength) break;
        if (depth[next] < 0) {
          depth[next] = here + 1;
          grown.emplace_back(step.node, at);
          if (depth[next] == kPathLength) ends.push_back(step.node);
        }
        at = step.node;
      }
    }
  }

  [[nodiscard]] PathTree tree() const {
    PathTree tree(built.graph, built.start);
    for (const auto& [id, from] : grown) {
      tree.expand(from);
      tree.attach(id, built.graph.edge_time(from, id).value());
    }
    return tree;
  }
  /// Of each end, the neighbours that are not on the way to it. New ones only: those the tree has
  /// not come to yet, each once.
  [[nodiscard]] std::vector<std::vector<ViewEdge>> neighbors(const PathTree& tree,
                                                             bool new_only) const {
    std::vector<bool> taken(built.graph.id_count(), false);
    std::vector<std::vector<ViewEdge>> found;
    for (const NodeId end : ends) {
      found.emplace_back();
      const std::vector<NodeId> path = path_to(end);
      for (const auto& edge : built.graph.node(end).edges) {
        if (std::find(path.begin(), path.end(), edge.to) != path.end()) continue;
        const auto id = static_cast<std::size_t>(edge.to);
        if (edge.to == built.start || (new_only && (taken[id] || tree.reached(edge.to)))) continue;
        taken[id] = true;
        found.back().push_back(edge);
      }
    }
    return found;
  }
  /// The views on the way to an end.
  [[nodiscard]] std::vector<NodeId> path_to(NodeId end) const {
    std::vector<NodeId> path;
    for (auto step = grown.rbegin(); step != grown.rend(); ++step) {
      if (step->first != end) continue;
      path.push_back(end);
      end = step->second;
    }
    return path;
  }
};

Search& search() {
  static Search one;
  return one;
}

/// As the search does before it expands a node.
void cast_anew(const std::vector<ViewEdge>& neighbors) {
  ViewGraph& graph = search().built.graph;
  std::vector<NodeId> ids;
  for (const auto& edge : neighbors) {
    graph.node(edge.to).cast.reset();
    ids.push_back(edge.to);
  }
  WorkMeter work;
  ensure_casts(graph, ids, segment().map(), kFan, work);
}

/// Expands the tree's ends: C(n), then U of each neighbour. Cold: only neighbours that are come to
/// for the first time, their views cast then, as in a search after a frame that changed everything.
void expand_ends(benchmark::State& state, bool cold) {
  PathTree tree = search().tree();
  const auto neighbors = search().neighbors(tree, cold);
  const PathTree fresh = tree;
  std::int64_t evaluated = 0;
  double sum = 0.0;
  std::size_t i = 0;
  const auto expand = [&] {
    tree.expand(search().ends[i]);
    if (cold) cast_anew(neighbors[i]);
    for (const auto& edge : neighbors[i]) sum += tree.utility_behind(edge.to, edge.time_s);
    evaluated += static_cast<std::int64_t>(neighbors[i].size());
    i = (i + 1) % neighbors.size();
  };
  if (!cold) {  // the first time prepares the sets
    for (std::size_t k = 0; k < neighbors.size(); ++k) expand();
    evaluated = 0;
  }
  for (auto _ : state) {
    if (cold && i == 0) {
      state.PauseTiming();
      tree = fresh;
      state.ResumeTiming();
    }
    expand();
  }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(evaluated);
}

void expansions(benchmark::State& state) { expand_ends(state, false); }
void expansions_cold(benchmark::State& state) { expand_ends(state, true); }
BENCHMARK(expansions);
void expansions_cold_two_threads(benchmark::State& state) {
  const Threads two(2);
  expand_ends(state, true);
}
BENCHMARK(expansions_cold);
BENCHMARK(expansions_cold_two_threads)->UseRealTime();

// --- the published way ---

using octomap::KeySet;

octomap::point3d point(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// The same map as an octree.
const octomap::OcTree& octree() {
  static const octomap::OcTree tree = [] {
    const VoxelMap& map = segment().map();
    octomap::OcTree copy(map.resolution_m());
    for (const BlockKey key : map.block_keys()) {
      for_each_voxel(key, map.block(key)->observed, [&](const VoxelIndex& v) {
        copy.setNodeValue(point(voxel_centre(v, map.resolution_m())),
                          static_cast<float>(map.occupancy_log_odds(v)), true);
      });
    }
    copy.updateInnerOccupancy();
    return copy;
  }();
  return tree;
}

KeySet visible_unknown(const Pose& T_world_camera) {
  const octomap::OcTree& tree = octree();
  KeySet unknown;
  octomap::KeyRay ray;
  for (int row = 0; row < kFan.rows; ++row) {
    for (int column = 0; column < kFan.columns; ++column) {
      const double x = std::tan(kFan.fov_x_rad / 2) * (2.0 * column / (kFan.columns - 1) - 1.0);
      const double y = std::tan(kFan.fov_y_rad / 2) * (2.0 * row / (kFan.rows - 1) - 1.0);
      const Vec3 end = T_world_camera * (kFan.depth_m * Vec3(x, y, 1.0));
      tree.computeRayKeys(point(T_world_camera.translation()), point(end), ray);
      for (const auto& key : ray) {
        const auto* node = tree.search(key);
        if (node == nullptr) {
          unknown.insert(key);
        } else if (tree.isNodeOccupied(node)) {
          break;
        }
      }
    }
  }
  return unknown;
}

/// For each neighbour: its view cast, the path's set copied, the union, its size.
void expansions_octomap(benchmark::State& state) {
  constexpr std::size_t kEnds = 4;
  const PathTree tree = search().tree();
  const auto neighbors = search().neighbors(tree, true);
  const auto cells_of = [](NodeId id) {
    return visible_unknown(search().built.graph.node(id).view.T_world_camera);
  };
  std::vector<KeySet> covered;
  for (std::size_t k = 0; k < kEnds; ++k) {
    covered.emplace_back();
    for (const NodeId id : search().path_to(search().ends[k])) {
      const KeySet cells = cells_of(id);
      covered.back().insert(cells.begin(), cells.end());
    }
  }
  std::int64_t evaluated = 0;
  std::size_t sum = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    for (const auto& edge : neighbors[i]) {
      KeySet along = covered[i];
      const KeySet cells = cells_of(edge.to);
      along.insert(cells.begin(), cells.end());
      sum += along.size();
      ++evaluated;
    }
    i = (i + 1) % kEnds;
  }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(evaluated);
}
BENCHMARK(expansions_octomap);

}  // namespace
}  // namespace canopeer
