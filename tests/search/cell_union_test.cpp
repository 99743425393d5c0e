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
      ASSERT_EQ(cells.count_new(set, prepared), plain.count_new(set));
      cells.add(set, prepared);
      plain.merge(set);
      ASSERT_EQ(cells.count_new(set, prepared), 0);
    }
  }
}

VoxelSet moved(const VoxelSet& set, const VoxelIndex& by_blocks) {
  std::vector<BlockKey> keys;
  for (const BlockKey key : set.keys()) {
    const VoxelIndex at = block_index(key) + by_blocks;
    keys.push_back(pack_block(at.x(), at.y(), at.z()));
  }
  return VoxelSet(keys, set.places(), set.words());
}

TEST(CellUnion, SetsPreparedEarlierStayValidWhenLaterOnesLieElsewhere) {
  Rng rng(13);
  CellUnion cells;
  std::vector<VoxelSet> sets;
  std::vector<CellUnion::Prepared> prepared;
  for (int i = 0; i < 40; ++i) {
    const auto along = [&] { return static_cast<int>(rng.index(120)) - 60; };
    sets.push_back(moved(random_set(rng), VoxelIndex(along(), along(), along() / 2)));
    prepared.push_back(cells.prepare(sets.back()));
  }
  VoxelSet plain;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    ASSERT_EQ(cells.count_new(sets[i], prepared[i]), plain.count_new(sets[i]));
    cells.add(sets[i], prepared[i]);
    plain.merge(sets[i]);
  }
  cells.clear();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ(cells.count_new(sets[i], prepared[i]), sets[i].count());
  }
}

}  // namespace
}  // namespace canopeer
