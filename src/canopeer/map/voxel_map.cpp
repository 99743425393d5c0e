#include "canopeer/map/voxel_map.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/map/storage/voxel_bounds.h"

namespace canopeer {
namespace {

// ± 16 in 16 bits (two probabilities at their limits fit), error of a step below 2.5e-4.
constexpr double kFixedPointScale = 2048.0;
constexpr double kMinProbability = 0.0005;
constexpr double kMaxProbability = 0.9995;

double log_odds_of(double probability) { return std::log(probability / (1.0 - probability)); }

std::int16_t to_fixed_point(double log_odds) {
  return static_cast<std::int16_t>(std::lround(log_odds * kFixedPointScale));
}

}  // namespace

Expected<void> VoxelMapOptions::validate() const {
  if (!(resolution_m > 0.0 && std::isfinite(resolution_m))) {
    return fail("resolution_m must be positive");
  }
  if (!(hit_probability > 0.5 && hit_probability <= kMaxProbability)) {
    return fail("hit_probability must lie in (0.5, 0.9995]");
  }
  if (!(miss_probability >= kMinProbability && miss_probability < 0.5)) {
    return fail("miss_probability must lie in [0.0005, 0.5)");
  }
  if (!(clamp_min >= kMinProbability && clamp_min < occupied_threshold &&
        occupied_threshold < clamp_max && clamp_max <= kMaxProbability)) {
    return fail("0.0005 <= clamp_min < occupied_threshold < clamp_max <= 0.9995 must hold");
  }
  return {};
}

VoxelMap::VoxelMap(const VoxelMapOptions& options)
    : options_(options),
      steps_(fixed_point(options)),
      confidence_steps_(confidence_steps(options)) {}

// The probability of being ROI rises with the confidence, from a miss at 0 to a hit at 255.
std::array<VoxelMap::FixedPoint, 256> VoxelMap::confidence_steps(const VoxelMapOptions& options) {
  std::array<FixedPoint, 256> steps;
  for (int c = 0; c < 256; ++c) {
    const double p = std::lerp(options.miss_probability, options.hit_probability, c / 255.0);
    steps[static_cast<std::size_t>(c)] = to_fixed_point(log_odds_of(p));
  }
  return steps;
}

LogOddsSteps VoxelMap::fixed_point(const VoxelMapOptions& options) {
  CANOPEER_CHECK(options.validate().has_value(), "VoxelMapOptions must be valid");
  const auto step = [](double probability) { return to_fixed_point(log_odds_of(probability)); };
  return {step(options.hit_probability), step(options.miss_probability), step(options.clamp_min),
          step(options.clamp_max), step(options.occupied_threshold)};
}

Occupancy VoxelMap::occupancy(const VoxelIndex& voxel) const {
  const BlockMasks* masks = block(block_key(voxel));
  if (masks == nullptr || !masks->observed.test(voxel)) return Occupancy::unknown;
  return masks->occupied.test(voxel) ? Occupancy::occupied : Occupancy::free;
}

bool VoxelMap::is_roi(const VoxelIndex& voxel) const {
  const BlockMasks* masks = block(block_key(voxel));
  return masks != nullptr && masks->roi.test(voxel);
}

double VoxelMap::occupancy_log_odds(const VoxelIndex& voxel) const {
  const auto slot = directory_.find(block_key(voxel));
  if (!slot) return 0.0;
  const Block& block = blocks_[*slot];
  if (block.log_odds != kNone) {
    return log_odds_[block.log_odds][voxel_offset(voxel)] / kFixedPointScale;
  }
  return masks_[*slot].observed.test(voxel) ? block.uniform / kFixedPointScale : 0.0;
}

double VoxelMap::roi_log_odds(const VoxelIndex& voxel) const {
  const auto slot = directory_.find(block_key(voxel));
  if (!slot || blocks_[*slot].roi_log_odds == kNone) return 0.0;
  return roi_log_odds_[blocks_[*slot].roi_log_odds][voxel_offset(voxel)] / kFixedPointScale;
}

std::uint64_t VoxelMap::block_version(BlockKey key) const {
  const auto slot = directory_.find(key);
  return slot ? blocks_[*slot].version : 0;
}

std::size_t VoxelMap::memory_bytes() const {
  return directory_.memory_bytes() + blocks_.memory_bytes() + masks_.memory_bytes() +
         log_odds_.memory_bytes() + roi_log_odds_.memory_bytes() +
         unused_log_odds_.capacity() * sizeof(std::uint32_t);
}

std::vector<BlockKey> VoxelMap::block_keys() const {
  std::vector<BlockKey> keys;
  keys.reserve(blocks_.size());
  for (std::size_t slot = 0; slot < blocks_.size(); ++slot) keys.push_back(blocks_[slot].key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<BlockKey> VoxelMap::block_keys(const Box& world) const {
  const VoxelBounds bounds = VoxelBounds::inside(world, resolution_m());
  std::vector<BlockKey> keys;
  if (bounds.empty()) return keys;
  const VoxelIndex low = block_index(block_key(bounds.first));
  const VoxelIndex high = block_index(block_key(bounds.last));
  const Eigen::Vector3d size = (high - low).cast<double>().array() + 1.0;
  if (size.prod() > static_cast<double>(blocks_.size())) {
    for (std::size_t slot = 0; slot < blocks_.size(); ++slot) {
      if (bounds.overlaps_block(blocks_[slot].key)) keys.push_back(blocks_[slot].key);
    }
    std::sort(keys.begin(), keys.end());
    return keys;
  }
  // A small box: ask for its blocks, in the order of their keys.
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const BlockKey key = pack_block(x, y, z);
        if (directory_.find(key)) keys.push_back(key);
      }
    }
  }
  return keys;
}

void VoxelMap::for_each_occupied(const Box& world,
                                 const std::function<void(const VoxelIndex&)>& visit) const {
  const VoxelBounds bounds = VoxelBounds::inside(world, resolution_m());
  for (const BlockKey key : block_keys(world)) {
    for_each_voxel(key, VoxelMask(block(key)->occupied) &= bounds.mask(key), visit);
  }
}

void VoxelMap::for_each_roi(const Box& world,
                            const std::function<void(const VoxelIndex&)>& visit) const {
  const VoxelBounds bounds = VoxelBounds::inside(world, resolution_m());
  for (const BlockKey key : block_keys(world)) {
    for_each_voxel(key, VoxelMask(block(key)->roi) &= bounds.mask(key), visit);
  }
}

void VoxelMap::write_log_odds(const VoxelIndex& voxel, double log_odds, bool roi) {
  const BlockKey key = block_key(voxel);
  const std::size_t in_chunk = BlockDirectory::place_in_chunk(key);
  BlockDirectory::Chunk& chunk = directory_.chunk_to_write(key);
  const std::uint32_t slot = slot_for(chunk, in_chunk, key);
  Block& block = blocks_.own(slot);
  BlockMasks& masks = masks_.own(slot);
  const double clamped =
      std::clamp(log_odds, steps_.min / kFixedPointScale, steps_.max / kFixedPointScale);
  const FixedPoint value = to_fixed_point(clamped);
  const auto z = static_cast<std::size_t>(VoxelMask::slice_of(voxel));
  const std::uint64_t bit = VoxelMask::bit_of(voxel);
  VoxelMask& above = roi ? masks.roi : masks.occupied;
  std::int64_t& above_count = roi ? roi_voxels_ : occupied_voxels_;
  (roi ? roi_log_odds_.owned(own_roi_log_odds(block))
       : log_odds_.owned(own_log_odds(block, masks.observed)))[voxel_offset(voxel)] = value;
  above_count -= (above.slices[z] & bit) != 0;
  above.slices[z] &= ~bit;
  if (value >= steps_.threshold) {
    above.slices[z] |= bit;
    ++above_count;
  }
  if (!roi) {
    observed_voxels_ += (masks.observed.slices[z] & bit) == 0;
    masks.observed.slices[z] |= bit;
  }
  chunk.summaries[in_chunk] = summary_of(masks);
  block.version = ++updates_;
}

void VoxelMap::set_occupancy_log_odds(const VoxelIndex& voxel, double log_odds) {
  write_log_odds(voxel, log_odds, false);
}

void VoxelMap::set_roi_log_odds(const VoxelIndex& voxel, double log_odds) {
  write_log_odds(voxel, log_odds, true);
}

}  // namespace canopeer
