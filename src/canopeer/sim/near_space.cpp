#include "canopeer/sim/near_space.h"

#include <algorithm>

#include "canopeer/base/check.h"
#include "canopeer/robot/arm_reach.h"
#include "canopeer/sim/touched_cells.h"

namespace canopeer {
namespace {

/// Distances are known so far: enough for the largest spheres, and a byte a voxel holds it.
constexpr int kTruncationCells = 15;

/// Room for rounding, here and in the exact judge.
constexpr double kPaddingM = 0.001;

/// A voxel that reaches into the arm's reach has its centre in here.
Box reach_of(const RobotModel& robot, const TrolleyState& trolley, double edge_m) {
  const Vec3 base = robot.T_world_base(trolley).translation();
  const Vec3 reach = Vec3::Constant(arm_reach_m(robot) + edge_m);
  return {base - reach, base + reach};
}

VoxelMapOptions cells_of(double edge_m) {
  VoxelMapOptions options;
  options.resolution_m = edge_m;
  return options;
}

DistanceFieldOptions distances_in(const Box& world, double edge_m) {
  DistanceFieldOptions options;
  options.world = world;
  options.truncation_m = kTruncationCells * edge_m;
  return options;
}

CollisionOptions hardly_padded() {
  CollisionOptions options;
  options.map_padding_m = kPaddingM;
  options.self_padding_m = kPaddingM;
  return options;
}

/// Voxels of `now` that `before`, which may be null, does not have.
VoxelMask added(const VoxelMask& now, const BlockMasks* before) {
  VoxelMask mask = now;
  if (before != nullptr) mask -= before->occupied;
  return mask;
}

}  // namespace

NearSpace::NearSpace(const RobotModel& robot, const Scene& scene, const TrolleyState& trolley,
                     double edge_m)
    : reach_world_(reach_of(robot, trolley, edge_m)),
      solid_(cells_of(edge_m)),
      field_(distances_in(reach_world_, edge_m), edge_m),
      checker_(robot, trolley, hardly_padded()) {
  checker_.set_map(&field_);
  TouchedCells touched(edge_m, reach_world_);
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
    if (reach_world_.intersects(transformed(part.mesh.bounds(), T))) touched.add(part.mesh, T);
  });
  std::vector<BlockUpdate> updates;
  for (const auto& [key, cells] : touched.blocks()) {
    updates.emplace_back();
    updates.back().key = key;
    updates.back().hit = cells;
  }
  mark(std::move(updates));
}

void NearSpace::add(const VoxelMap& map) {
  CANOPEER_CHECK(map.resolution_m() == edge_m(), "the map's voxels are the cells");
  const VoxelIndex low = block_index(block_key(voxel_at(reach_world_.min(), edge_m())));
  const VoxelIndex high = block_index(block_key(voxel_at(reach_world_.max(), edge_m())));
  std::vector<BlockUpdate> updates;
  map.for_each_block([&](BlockKey key, const BlockMasks& masks) {
    const VoxelIndex block = block_index(key);
    if ((block.array() < low.array()).any() || (block.array() > high.array()).any()) return;
    if (!masks.occupied.any()) return;
    const VoxelMask fresh = added(masks.occupied, solid_.block(key));
    if (!fresh.any()) return;
    updates.emplace_back();
    updates.back().key = key;
    updates.back().hit = fresh;
  });
  if (!updates.empty()) mark(std::move(updates));
}

void NearSpace::mark(std::vector<BlockUpdate> updates) {
  field_.update(solid_, solid_.apply(updates).changed);
}

bool NearSpace::surely_free(const Configuration& q) const { return checker_.state_free(q); }

}  // namespace canopeer
