#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "canopeer/base/simd_level.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/map/storage/block.h"

namespace canopeer {

/// A voxel of a window in one word: 21 bits an axis, x lowest, from the window's first voxel, which
/// is the first of its block.
using PackedVoxel = std::int64_t;

namespace packed_voxel {
inline constexpr int kFieldBits = 21;
inline constexpr PackedVoxel kOneOf[3] = {1, PackedVoxel{1} << kFieldBits,
                                          PackedVoxel{1} << 2 * kFieldBits};
inline constexpr PackedVoxel kInBlock = (kBlockSide - 1) * (kOneOf[0] + kOneOf[1] + kOneOf[2]);

inline constexpr PackedVoxel kBlockField = (1 << (kFieldBits - kBlockShift)) - 1;

/// The voxel's block, counted from the window's first, in the same fields. Add it to the key of
/// that one for its own.
inline BlockKey block_of(PackedVoxel p) {
  return static_cast<BlockKey>(p >> kBlockShift) &
         static_cast<BlockKey>(kBlockField * (kOneOf[0] + kOneOf[1] + kOneOf[2]));
}
template <int axis>
std::uint32_t field(BlockKey block) {
  return static_cast<std::uint32_t>(block >> (axis * kFieldBits) & BlockKey{kBlockField});
}
}  // namespace packed_voxel

/// Eight voxel walks side by side.
struct RayLanes {
  static constexpr std::size_t kCount = 8;
  using Lanes = std::array<std::int64_t, kCount>;
  /// Room for eight items of a step.
  template <typename T>
  struct alignas(64) Row {
    std::array<T, 64 / sizeof(T)> items;
  };
  alignas(64) Lanes at;  ///< packed
  alignas(64) std::array<Lanes, 3> t;
  alignas(64) std::array<Lanes, 3> dt;
  alignas(64) std::array<Lanes, 3> move;  ///< packed
  alignas(64) Lanes steps;

  /// `corner`: the window's first voxel.
  void set(std::size_t lane, const VoxelWalk& walk, const VoxelIndex& corner) {
    steps[lane] = walk.steps;
    const VoxelIndex start = walk.first - corner;
    at[lane] = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      at[lane] += start[axis] * packed_voxel::kOneOf[axis];
      t[a][lane] = walk.t_next[axis];
      dt[a][lane] = walk.t_delta[axis];
      move[a][lane] = walk.step[axis] * packed_voxel::kOneOf[axis];
    }
  }
};

/// Sets all lanes to the walks `from` → ends[lane], the last one repeated in those that are left.
/// `ends`: 1 … 8; all in front of `corner`, the window's first voxel.
using StartRays = void (*)(const Vec3& from, std::span<const Vec3> ends, double resolution_m,
                           const VoxelIndex& corner, RayLanes& rays);

/// Where eight walks go: item step · 8 + lane, from addresses that are multiples of 64.
///
/// A slice of a block is one word of its mask; the steps of a walk that lie in one slice are a run.
struct RaySteps {
  PackedVoxel* at = nullptr;
  std::uint8_t* slice = nullptr;  ///< of its block
  /// The voxels of the run up to here, as bits of the slice; at the run's end all of them.
  std::uint64_t* run = nullptr;
  /// Per step, bit lane: the next voxel lies in another slice, in another block.
  std::uint8_t* leaves_slice = nullptr;
  std::uint8_t* leaves_block = nullptr;
};

/// Walks as walk_voxels() does, `voxels` voxels in all lanes; a walk shorter than that goes on past
/// its end. At most 64 times the steps of the shortest one, or times overflow.
using WalkRays = void (*)(const RayLanes& rays, std::size_t voxels, const RaySteps& out);

/// Turns bits per step and lane (`steps` steps, read in eights) into a row of bits a lane. Bit i of
/// word w is that of step 64 w + i. Returns the words of a row.
std::size_t turn_to_rows(const std::uint8_t* lanes, std::size_t steps, std::uint64_t* rows);

/// `level` must be one the machine has.
StartRays start_rays_kernel(SimdLevel level);
WalkRays walk_rays_kernel(SimdLevel level);

}  // namespace canopeer
