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

  // What a ray meets in a block.
  struct Seen {
    const VoxelMask* observed;  // of a clear block (nothing to find, nothing in the way) kClear
    const VoxelMask* occupied;  // never nullptr
    const BlockMasks* known;    // nullptr: nothing observed there
  };
  struct alignas(64) Crossed : VoxelMask {};
  struct Ray {
    std::size_t voxels;        // it crosses
    std::size_t unknown_left;  // it may still cross
  };
  // A block on a ray's way, and the ray's first step there.
  struct OnTheWay {
    std::uint32_t step, cell, number;
  };
  // Memory that a thread uses again from view to view. Blocks met are numbered from 1.
  struct Scratch {
    std::vector<std::uint32_t> number;   // per cell: kNew, or the block's number
    std::vector<std::uint64_t> entered;  // per cell a bit: some ray came here
    std::vector<BlockKey> keys;          // per number, as the next three
    std::vector<Seen> seen;
    std::vector<Crossed> crossed;  // voxels crossed before an occupied one; none of clear blocks
    std::vector<VoxelMask> stops;  // where rays stopped; only for all_
    std::vector<std::uint32_t> in_order;
    std::vector<VoxelSet::Block> found;
    // Of the rays being cast.
    RayLanes lanes;
    std::vector<RayLanes::Row<PackedVoxel>> at;
    std::vector<RayLanes::Row<std::uint16_t>> offset;
    std::vector<std::uint8_t> enters;
    std::vector<std::uint64_t> turned;  // the same, a row of bits a lane
    std::vector<OnTheWay> way;
  };
  static Scratch& scratch();

  void cast_together(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  void make_room(std::size_t voxels);
  std::size_t find_way(std::size_t lane, std::size_t voxels, std::size_t words, OnTheWay* way);
  void look_up_new();
  Seen look_up(BlockKey key);
  void follow(std::size_t lane, std::span<const OnTheWay> way, Ray ray);
  bool walk_in_block(std::uint32_t number, const std::uint16_t* offsets, std::size_t voxels,
                     std::size_t& unknown_left);
  void stop_at(std::uint32_t number, std::size_t slice, std::uint64_t bit);
  // Numbers of the blocks entered, sorted by key.
  std::span<const std::uint32_t> entered() const;

  const VoxelMap& map_;
  bool all_;
  WalkRays walk_rays_;
  VoxelIndex first_block_;
  VoxelIndex blocks_;  // of the window, per axis
  Scratch& memory_;
  std::uint32_t met_ = 0;        // blocks numbered
  std::uint32_t looked_up_ = 0;  // of them
  BlockKey chunk_key_ = ~BlockKey{0};
  const BlockDirectory::Chunk* chunk_ = nullptr;  // the last one asked for
};

}  // namespace canopeer
