#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "canopeer/map/view_cast.h"
#include "canopeer/map/views/ray_kernels.h"
#include "canopeer/map/views/slice_kernels.h"

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

  struct Ray {
    std::size_t voxels;        // it crosses
    std::size_t unknown_left;  // it may still cross
  };
  // Memory that a thread uses again from view to view. Blocks met are numbered from 1.
  struct Scratch {
    std::vector<std::uint32_t> number;                 // per cell: kNew, or the block's number
    std::vector<std::uint64_t> entered;                // per cell a bit: some ray came here
    std::vector<const BlockDirectory::Chunk*> chunks;  // nullptr: not asked for yet
    std::vector<MetBlock> met;                         // per number
    std::vector<VoxelMask> stops;  // per number, where rays stopped; only for all_
    std::vector<std::uint32_t> in_order;
    // What is unknown of it.
    std::vector<BlockKey> found_keys;
    std::vector<std::uint32_t> found_places;
    std::vector<std::uint64_t> found_words;
    // Of the rays being cast.
    RayLanes lanes;
    std::vector<RayLanes::Row<PackedVoxel>> at;
    std::vector<RayLanes::Row<std::uint64_t>> run;
    std::vector<std::uint8_t> slice;
    std::vector<std::uint8_t> leaves_slice, leaves_block;
    std::vector<std::uint64_t> slice_ends, block_ends;  // the same, a row of bits a lane
    std::vector<MetBlock*> way;                         // the blocks each could come to
  };
  static Scratch& scratch();

  // Up to eight rays. The same body for machines with and without instructions for single bits.
  void cast_together(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  void cast_with_bmi2(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  void cast_plain(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  void cast_body(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m);
  void make_room(std::size_t voxels);
  void close_row(std::size_t lane, std::size_t voxels, std::size_t words);
  std::size_t find_way(std::size_t lane, std::size_t words, MetBlock** way);
  void look_up_new();
  template <bool kLimited>
  void follow(std::size_t lane, std::size_t words, MetBlock* const* way, std::size_t unknown_left);
  void end_in_run(std::size_t lane, std::size_t step, MetBlock& block, std::size_t unknown_left);
  void stop_at(const MetBlock& block, std::size_t slice, std::uint64_t bit);
  // Numbers of the blocks entered, sorted by key.
  std::span<const std::uint32_t> entered() const;

  const VoxelMap& map_;
  bool all_;
  bool has_bmi2_;
  StartRays start_rays_;
  WalkRays walk_rays_;
  CollectUnknown collect_unknown_;
  BlockKey first_key_ = 0;  // of the window
  VoxelIndex first_block_;
  VoxelIndex blocks_;  // per axis
  VoxelIndex chunks_;  // that they lie in, per axis
  Scratch& memory_;
  std::uint32_t met_ = 0;        // blocks numbered
  std::uint32_t looked_up_ = 0;  // of them
};

}  // namespace canopeer
