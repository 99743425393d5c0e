#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/map/storage/block.h"
#include "canopeer/map/storage/block_directory.h"
#include "canopeer/map/storage/log_odds_kernels.h"
#include "canopeer/map/storage/paged_array.h"

namespace canopeer {

enum class Occupancy : std::uint8_t { unknown, free, occupied };

/// Probabilities as in OctoMap (Hornung et al., 2013); the same increments, clamps and threshold
/// hold for the ROI log-odds.
struct VoxelMapOptions {
  double resolution_m = 0.01;
  double hit_probability = 0.7;     ///< (0.5, 0.9995]
  double miss_probability = 0.4;    ///< [0.0005, 0.5)
  double clamp_min = 0.12;          ///< lowest probability a voxel can reach; ≥ 0.0005
  double clamp_max = 0.97;          ///< highest; ≤ 0.9995
  double occupied_threshold = 0.5;  ///< occupied, or ROI, at this probability and above

  [[nodiscard]] Expected<void> validate() const;
};

/// What one block's voxels are.
struct BlockMasks {
  VoxelMask observed;
  VoxelMask occupied;  ///< ⊂ observed
  VoxelMask roi;
};

/// What one observation says about one block's voxels. A voxel is in at most one of hit and miss,
/// and in at most one of roi_hit and roi_miss.
struct BlockUpdate {
  BlockKey key = 0;
  VoxelMask hit;
  VoxelMask miss;
  VoxelMask roi_hit;
  VoxelMask roi_miss;
  /// How sure the hits of `roi_hit` are, per voxel of the block (x fastest), 0 … 255; nullptr: 255
  /// all. Must live until the update is applied.
  const std::uint8_t* roi_confidence = nullptr;
};

/// Voxels of a block that are seen free: a miss each.
struct FreeBlock {
  BlockKey key = 0;
  VoxelMask free;
};

/// What an update changed.
struct UpdateResult {
  std::int64_t newly_known = 0;     ///< voxels unknown before, known after
  std::int64_t updated_voxels = 0;  ///< voxels that got a hit or a miss
  std::vector<BlockKey> changed;    ///< blocks whose masks changed, sorted
};

/// Voxel map of the world. Each voxel has a log-odds of being occupied and one of being region of
/// interest (fruit). Voxels lie in a hash of blocks of 8³; each block has bit masks of what its
/// voxels are. Log-odds are fixed point (1/2048), so sums do not depend on order or machine. A
/// block whose observed voxels all have one log-odds (most of free space) keeps just that.
///
/// Const calls are thread-safe. A copy is a snapshot: it shares with the original what neither has
/// changed since. It costs a pointer a page of some dozen blocks. Another thread may read (or
/// write) it while this map takes the next frame.
class VoxelMap {
 public:
  /// `options` must be valid.
  explicit VoxelMap(const VoxelMapOptions& options = {});

  [[nodiscard]] const VoxelMapOptions& options() const { return options_; }
  [[nodiscard]] double resolution_m() const { return options_.resolution_m; }
  [[nodiscard]] Occupancy occupancy(const VoxelIndex& voxel) const;
  [[nodiscard]] bool is_roi(const VoxelIndex& voxel) const;
  /// Natural logarithm of p / (1 − p); 0 when never observed.
  [[nodiscard]] double occupancy_log_odds(const VoxelIndex& voxel) const;
  [[nodiscard]] double roi_log_odds(const VoxelIndex& voxel) const;

  [[nodiscard]] std::int64_t observed_voxels() const { return observed_voxels_; }
  [[nodiscard]] std::int64_t occupied_voxels() const { return occupied_voxels_; }
  [[nodiscard]] std::int64_t roi_voxels() const { return roi_voxels_; }
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Occupied (ROI) voxels whose centres lie in `world`, sorted by block, then z, y, x.
  void for_each_occupied(const Box& world,
                         const std::function<void(const VoxelIndex&)>& visit) const;
  void for_each_roi(const Box& world, const std::function<void(const VoxelIndex&)>& visit) const;

  /// The block's masks, or nullptr: nothing observed there. Valid until the next change.
  [[nodiscard]] const BlockMasks* block(BlockKey key) const {
    const auto slot = directory_.find(key);
    return slot ? &masks_[*slot] : nullptr;
  }
  /// The masks of a block by its slot in chunk().
  [[nodiscard]] const BlockMasks& block_in_slot(std::uint32_t slot) const { return masks_[slot]; }
  /// The 4 × 4 × 4 blocks around `key` (slots mean nothing outside); nullptr: nothing observed.
  [[nodiscard]] const BlockDirectory::Chunk* chunk(BlockKey key) const {
    return directory_.chunk(key);
  }
  /// Number of updates so far: block_version() of what changes from now on is larger.
  [[nodiscard]] std::uint64_t version() const { return updates_; }
  /// Number of the update that last changed the block's masks; 0: never.
  [[nodiscard]] std::uint64_t block_version(BlockKey key) const;
  /// Observed blocks, sorted; the second form only those that overlap `world`.
  [[nodiscard]] std::vector<BlockKey> block_keys() const;
  [[nodiscard]] std::vector<BlockKey> block_keys(const Box& world) const;

  /// `visit(BlockKey, const BlockMasks&)` for all observed blocks, in the order they were first
  /// observed.
  template <typename Visit>
  void for_each_block(Visit&& visit) const {
    for (std::size_t slot = 0; slot < blocks_.size(); ++slot) {
      visit(blocks_[slot].key, masks_[slot]);
    }
  }

  /// Applies an observation: `updates`, a miss for every voxel of the blocks `all_free`, and for
  /// the voxels of `free`; no key twice, in none of them. Parallel over blocks, the same result
  /// with any number of threads and any level of `simd` the machine has.
  UpdateResult apply(std::span<const BlockUpdate> updates, std::span<const BlockKey> all_free = {},
                     std::span<const FreeBlock> free = {}, SimdLevel simd = best_simd_level());
  /// Sets a voxel's occupancy as a map file gives it (clamped, then rounded to 1/2048).
  void set_occupancy_log_odds(const VoxelIndex& voxel, double log_odds);
  void set_roi_log_odds(const VoxelIndex& voxel, double log_odds);

 private:
  using FixedPoint = std::int16_t;
  using BlockLogOdds = std::array<FixedPoint, kBlockVoxels>;
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  struct Block {
    BlockKey key = 0;
    std::uint64_t version = 0;
    std::uint32_t log_odds = kNone;      // place in log_odds_; kNone: all observed have `uniform`
    std::uint32_t roi_log_odds = kNone;  // only blocks with end points in them have some
    FixedPoint uniform = 0;
  };
  // Where an update goes; looked up and made this map's own before any thread writes.
  struct Place {
    std::uint32_t slot = 0;
    std::uint8_t* summary = nullptr;
    const BlockUpdate* update = nullptr;
    const VoxelMask* miss = nullptr;  // neither: a miss for every voxel
  };
  struct Outcome {
    bool changed = false, uniform = false;
    int stepped = 0, observed = 0, occupied = 0, roi = 0;
  };

  static LogOddsSteps fixed_point(const VoxelMapOptions& options);
  static std::array<FixedPoint, 256> confidence_steps(const VoxelMapOptions& options);
  std::uint32_t slot_for(BlockDirectory::Chunk& chunk, std::size_t place, BlockKey key);
  [[nodiscard]] FixedPoint after_miss(FixedPoint value) const;
  std::uint32_t own_log_odds(Block& block, const VoxelMask& observed);
  std::uint32_t own_roi_log_odds(Block& block);
  bool apply_alike(const VoxelMask& miss, const Place& place, UpdateResult& result);
  bool apply_uniform(const Place& place, UpdateResult& result);
  void take_storage(const BlockUpdate& update, const Place& place);
  Outcome apply(const BlockUpdate& update, const Place& place, const LogOddsKernels& kernels);
  Outcome apply_misses(const VoxelMask& miss, const Place& place, const LogOddsKernels& kernels);
  Outcome finish(const BlockMasks& before, int stepped, const Place& place);
  Outcome apply_all_free(const Place& place, const LogOddsKernels& kernels);
  void step_roi(const BlockUpdate& update, const Block& block, const LogOddsKernels& kernels,
                VoxelMask& roi);
  void count(const Outcome& outcome, std::uint32_t slot, UpdateResult& result);
  static std::uint8_t summary_of(const BlockMasks& masks);
  static Outcome compare(const BlockMasks& before, const BlockMasks& now);
  void write_log_odds(const VoxelIndex& voxel, double log_odds, bool roi);

  VoxelMapOptions options_;
  LogOddsSteps steps_;
  std::array<FixedPoint, 256> confidence_steps_;
  BlockDirectory directory_;
  PagedArray<Block, 512> blocks_;
  PagedArray<BlockMasks, 128> masks_;
  PagedArray<BlockLogOdds, 32> log_odds_;
  PagedArray<BlockLogOdds, 32> roi_log_odds_;
  std::vector<std::uint32_t> unused_log_odds_;  // places in log_odds_ nobody has any more
  std::uint64_t updates_ = 0;
  std::int64_t observed_voxels_ = 0;
  std::int64_t occupied_voxels_ = 0;
  std::int64_t roi_voxels_ = 0;
};

}  // namespace canopeer
