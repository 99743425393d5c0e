#include "small_graph.h"

#include <map>
#include <utility>

namespace canopeer::test {

NodeId add_view(ViewGraph& graph, TargetKind kind, const std::vector<VoxelIndex>& sees) {
  ViewPose view;
  view.q = Configuration::Zero(6);
  view.kind = kind;
  const NodeId id = graph.add(std::move(view));
  std::map<BlockKey, VoxelMask> masks;
  for (const auto& voxel : sees) masks[block_key(voxel)].set(voxel);
  std::vector<VoxelSet::Block> blocks;
  for (const auto& [key, mask] : masks) blocks.push_back({key, mask});
  graph.node(id).cast = ViewCast{VoxelSet(std::move(blocks)), {}};
  return id;
}

std::vector<VoxelIndex> random_voxels(Rng& rng, int count) {
  std::vector<VoxelIndex> voxels;
  for (int i = 0; i < count; ++i) {
    voxels.push_back({static_cast<int>(rng.index(24)) - 12, static_cast<int>(rng.index(8)),
                      static_cast<int>(rng.index(8))});
  }
  return voxels;
}

ViewGraph random_graph(Rng& rng, int nodes, int extra_edges) {
  ViewGraph graph;
  for (int i = 0; i < nodes; ++i) {
    const TargetKind kind = i == 0            ? TargetKind::none
                            : rng.chance(0.3) ? TargetKind::roi
                                              : TargetKind::occupied;
    const NodeId id =
        add_view(graph, kind, random_voxels(rng, 5 + static_cast<int>(rng.index(60))));
    if (i == 0) {
      graph.node(id).visited = true;
    } else {
      graph.connect(id, static_cast<NodeId>(rng.index(static_cast<std::uint64_t>(i))),
                    rng.uniform(0.2, 2.0));
    }
  }
  for (int i = 0; i < extra_edges; ++i) {
    const auto a = static_cast<NodeId>(rng.index(static_cast<std::uint64_t>(nodes)));
    const auto b = static_cast<NodeId>(rng.index(static_cast<std::uint64_t>(nodes)));
    graph.connect(a, b, rng.uniform(0.2, 2.0));
  }
  return graph;
}

double utility_by_definition(const ViewGraph& graph, NodeId start,
                             const std::vector<NodeId>& nodes) {
  std::set<std::tuple<int, int, int>> seen;
  double length_s = 0.0;
  int roi_views = 0;
  NodeId at = start;
  for (const NodeId id : nodes) {
    graph.node(id).cast->unknown.for_each(
        [&](const VoxelIndex& v) { seen.emplace(v.x(), v.y(), v.z()); });
    length_s += graph.edge_time(at, id).value();
    roi_views += graph.node(id).view.kind == TargetKind::roi ? 1 : 0;
    at = id;
  }
  if (nodes.empty()) return 0.0;
  return static_cast<double>(seen.size()) / length_s * (roi_views + 1) /
         (static_cast<double>(nodes.size()) + 1.0);
}

}  // namespace canopeer::test
