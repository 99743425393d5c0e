#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/map/block.h"
#include "canopeer/map/block_directory.h"

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
};

struct UpdateResult {
  std::int64_t newly_known = 0;     ///< voxels unknown before, known after
  std::int64_t updated_voxels = 0;  ///< voxels that got a hit or a miss
  std::vector<BlockKey> changed;    ///< blocks whose masks changed, sorted
};

/// Voxel map of the world: per voxel a log-odds of being occupied and one of being region of
/// interest (fruit), in a hash of 8³ blocks; per block bit masks of what the voxels are. Log-odds
/// are fixed point (1/2048), so sums do not depend on order or machine. Const calls are
/// thread-safe; a copy is a snapshot.
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
  /// The 4 × 4 × 4 blocks around `key` (slots mean nothing outside); nullptr: nothing observed.
  [[nodiscard]] const BlockDirectory::Chunk* chunk(BlockKey key) const {
    return directory_.chunk(key);
  }
  /// Number of the update that last changed the block's masks; 0: never.
  [[nodiscard]] std::uint64_t block_version(BlockKey key) const;
  /// Observed blocks, sorted; the second form only those that overlap `world`.
  [[nodiscard]] std::vector<BlockKey> block_keys() const;
  [[nodiscard]] std::vector<BlockKey> block_keys(const Box& world) const;

  /// `visit(BlockKey, const BlockMasks&)` for all observed blocks, in the order they were first
  /// observed.
  template <typename Visit>
  void for_each_block(Visit&& visit) const {
    for (std::size_t slot = 0; slot < keys_.size(); ++slot) visit(keys_[slot], masks_[slot]);
  }

  /// Applies an observation; no key twice. Parallel over blocks, the same result with any number
  /// of threads.
  UpdateResult apply(std::span<const BlockUpdate> updates);
  /// Sets a voxel's occupancy as a map file gives it (clamped, then rounded to 1/2048).
  void set_occupancy_log_odds(const VoxelIndex& voxel, double log_odds);
  void set_roi_log_odds(const VoxelIndex& voxel, double log_odds);

 private:
  using FixedPoint = std::int16_t;
  using BlockLogOdds = std::array<FixedPoint, kBlockVoxels>;
  struct Increments {
    FixedPoint hit, miss, min, max, threshold;
  };
  static constexpr std::uint32_t kNoRoi = 0xFFFFFFFF;

  static Increments fixed_point(const VoxelMapOptions& options);
  static void add_log_odds(BlockLogOdds& log_odds, const VoxelMask& hit, const VoxelMask& miss,
                           const Increments& steps, VoxelMask& above);
  std::uint32_t slot_for(BlockKey key, bool with_roi);
  static std::uint8_t summary_of(const BlockMasks& masks);
  [[nodiscard]] bool settled(const BlockLogOdds& log_odds) const;
  void write_log_odds(const VoxelIndex& voxel, double log_odds, bool roi);

  VoxelMapOptions options_;
  Increments steps_;
  BlockDirectory directory_;
  std::vector<BlockKey> keys_;
  std::vector<BlockMasks> masks_;
  std::vector<std::uint64_t> versions_;
  std::deque<BlockLogOdds> log_odds_;
  // Only blocks with end points in them have ROI log-odds.
  std::vector<std::uint32_t> roi_slots_;
  std::deque<BlockLogOdds> roi_log_odds_;
  std::uint64_t updates_ = 0;
  std::int64_t observed_voxels_ = 0;
  std::int64_t occupied_voxels_ = 0;
  std::int64_t roi_voxels_ = 0;
};

}  // namespace canopeer
