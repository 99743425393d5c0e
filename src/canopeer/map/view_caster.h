#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "canopeer/map/ray_kernels.h"
#include "canopeer/map/view_cast.h"

namespace canopeer {

/// Collects the voxels that rays cross before the first occupied one, in a dense window of blocks.
/// One at a time a thread.
class ViewCaster {
 public:
  /// All rays lie within `world`. `all`: known voxels are wanted too, so no block is clear. `simd`
  /// must be a level the machine has; it changes the speed only.
  ViewCaster(const VoxelMap& map, const Box& world, bool all, SimdLevel simd);
  ViewCaster(const ViewCaster&) = delete;
  ViewCaster& operator=(const ViewCaster&) = delete;

  /// Each ray ends after crossing `max_unknown_m` of unknown space.
  void cast(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  [[nodiscard]] ViewCast result() const;
  [[nodiscard]] SeenVoxels all() const;

 private:
  static constexpr std::uint32_t kNew = 0;
  static constexpr std::uint32_t kClear = 0xFFFFFFFF;

  // A block met; blocks are numbered from 1.
  struct Met {
    BlockKey key;
    std::uint32_t crossed;  // place, or kClear: all free, nothing to find and nothing in the way
  };
  struct Crossed {
    const BlockMasks* known;    // nullptr: nothing observed there
    const VoxelMask* observed;  // never nullptr
    const VoxelMask* occupied;  // never nullptr
    VoxelMask voxels;           // crossed before an occupied one
  };
  struct Ray {
    std::size_t voxels;        // it crosses
    std::size_t unknown_left;  // it may still cross
  };
  // A block on a ray's way, and the ray's first step there.
  struct OnTheWay {
    std::uint32_t step, cell, crossed;
  };
  // Memory that a thread uses again from view to view.
  struct Scratch {
    std::vector<std::uint32_t> number;   // per cell: kNew, or the block's number
    std::vector<std::uint64_t> entered;  // per cell a bit: some ray came here
    std::vector<Met> met;
    std::vector<Crossed> crossed;
    std::vector<VoxelMask> stops;  // where rays stopped, by place in crossed; only for all_
    std::vector<VoxelSet::Block> found;
    // Of the rays being cast.
    RayLanes lanes;
    std::vector<RayLanes::Row<PackedVoxel>> at;
    std::vector<RayLanes::Row<std::uint16_t>> offset;
    std::vector<std::uint8_t> enters;
    std::vector<OnTheWay> way;
  };
  static Scratch& scratch();

  void cast_together(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  std::size_t find_way(std::size_t lane, std::size_t voxels);
  void follow(std::size_t lane, std::size_t blocks, Ray ray);
  bool walk_in_block(Crossed& block, const std::uint16_t* offsets, std::size_t voxels,
                     std::size_t& unknown_left);
  std::uint32_t number_new(BlockKey key);
  std::uint32_t look_up(BlockKey key);
  void stop_at(const Crossed& block, std::size_t slice, std::uint64_t bit);
  // `visit(BlockKey, const Crossed*)` (nullptr: clear) for the blocks entered, sorted by key.
  template <typename Visit>
  void for_each_entered(Visit&& visit) const;

  const VoxelMap& map_;
  bool all_;
  WalkRays walk_rays_;
  VoxelIndex first_block_;
  VoxelIndex blocks_;  // of the window, per axis
  Scratch& memory_;
  BlockKey chunk_key_ = ~BlockKey{0};
  const BlockDirectory::Chunk* chunk_ = nullptr;  // the last one asked for
};

}  // namespace canopeer
