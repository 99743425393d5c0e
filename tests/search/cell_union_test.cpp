#include "canopeer/search/cell_union.h"

#include <gtest/gtest.h>

#include "small_graph.h"

namespace canopeer {
namespace {

VoxelSet random_set(Rng& rng) {
  ViewGraph graph;
  const NodeId id = test::add_view(graph, TargetKind::roi,
                                   test::random_voxels(rng, static_cast<int>(rng.index(80))));
  return graph.node(id).cast->unknown;
}

TEST(CellUnion, CountsWhatVoxelSetsCount) {
  Rng rng(12);
  CellUnion cells;
  for (int round = 0; round < 50; ++round) {
    cells.clear();
    VoxelSet plain;
    for (int i = 0; i < 6; ++i) {
      const VoxelSet set = random_set(rng);
      const auto prepared = cells.prepare(set);
      ASSERT_EQ(cells.count_new(prepared), plain.count_new(set));
      cells.add(prepared);
      plain.merge(set);
      ASSERT_EQ(cells.count_new(prepared), 0);
    }
  }
}

}  // namespace
}  // namespace canopeer
