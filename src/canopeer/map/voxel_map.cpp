#include "canopeer/map/voxel_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "canopeer/base/check.h"
#include "canopeer/map/voxel_bounds.h"

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

std::size_t voxel_offset(const VoxelIndex& voxel) {
  constexpr int kMask = kBlockSide - 1;
  return static_cast<std::size_t>((voxel.z() & kMask) << (2 * kBlockShift) |
                                  (voxel.y() & kMask) << kBlockShift | (voxel.x() & kMask));
}

// One row of a block (8 voxels along x) in one vector register.
using Row = std::int16_t __attribute__((vector_size(16)));
using RowBytes = std::int8_t __attribute__((vector_size(8)));

Row spread(unsigned bits) {
  const Row lane_bit = {1, 2, 4, 8, 16, 32, 64, 128};
  const auto b = static_cast<std::int16_t>(bits);
  return (Row{b, b, b, b, b, b, b, b} & lane_bit) != 0;
}

unsigned gather(Row lanes_all_or_nothing) {
  const RowBytes bytes = __builtin_convertvector(lanes_all_or_nothing, RowBytes);
  std::uint64_t word = 0;
  std::memcpy(&word, &bytes, sizeof word);
  return static_cast<unsigned>((word & 0x0101010101010101U) * 0x0102040810204080U >> 56);
}

Row splat(std::int16_t v) { return Row{v, v, v, v, v, v, v, v}; }

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
    : options_(options), steps_(fixed_point(options)) {}

VoxelMap::Increments VoxelMap::fixed_point(const VoxelMapOptions& options) {
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
  return slot ? log_odds_[*slot][voxel_offset(voxel)] / kFixedPointScale : 0.0;
}

double VoxelMap::roi_log_odds(const VoxelIndex& voxel) const {
  const auto slot = directory_.find(block_key(voxel));
  if (!slot || roi_slots_[*slot] == kNoRoi) return 0.0;
  return roi_log_odds_[roi_slots_[*slot]][voxel_offset(voxel)] / kFixedPointScale;
}

std::uint64_t VoxelMap::block_version(BlockKey key) const {
  const auto slot = directory_.find(key);
  return slot ? versions_[*slot] : 0;
}

std::size_t VoxelMap::memory_bytes() const {
  return directory_.memory_bytes() + keys_.capacity() * sizeof(BlockKey) +
         masks_.capacity() * sizeof(BlockMasks) + versions_.capacity() * sizeof(std::uint64_t) +
         roi_slots_.capacity() * sizeof(std::uint32_t) +
         (log_odds_.size() + roi_log_odds_.size()) * sizeof(BlockLogOdds);
}

std::vector<BlockKey> VoxelMap::block_keys() const {
  std::vector<BlockKey> keys = keys_;
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
  if (size.prod() > static_cast<double>(keys_.size())) {
    for (const BlockKey key : keys_) {
      if (bounds.overlaps_block(key)) keys.push_back(key);
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

std::uint32_t VoxelMap::slot_for(BlockKey key, bool with_roi) {
  const std::uint32_t slot = directory_.find_or_add(key);
  if (slot == keys_.size()) {
    keys_.push_back(key);
    masks_.emplace_back();
    versions_.push_back(0);
    log_odds_.emplace_back();
    roi_slots_.push_back(kNoRoi);
  }
  if (with_roi && roi_slots_[slot] == kNoRoi) {
    roi_slots_[slot] = static_cast<std::uint32_t>(roi_log_odds_.size());
    roi_log_odds_.emplace_back();
  }
  return slot;
}

std::uint8_t VoxelMap::summary_of(const BlockMasks& masks) {
  unsigned summary = 0;
  if (masks.occupied.any()) summary |= BlockSummary::kOccupied;
  if (masks.observed.full()) summary |= BlockSummary::kComplete;
  if (masks.roi.any()) summary |= BlockSummary::kRoi;
  return static_cast<std::uint8_t>(summary);
}

bool VoxelMap::settled(const BlockLogOdds& log_odds) const {
  return std::all_of(log_odds.begin(), log_odds.end(),
                     [this](FixedPoint value) { return value == steps_.min; });
}

// Adds the steps, clamps, and refreshes the bits of `above` (log-odds ≥ threshold) where stepped.
void VoxelMap::add_log_odds(BlockLogOdds& log_odds, const VoxelMask& hit, const VoxelMask& miss,
                            const Increments& steps, VoxelMask& above) {
  const Row hit_step = splat(steps.hit);
  const Row miss_step = splat(steps.miss);
  const Row low = splat(steps.min);
  const Row high = splat(steps.max);
  const Row threshold = splat(steps.threshold);
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t stepped = hit.slices[z] | miss.slices[z];
    if (stepped == 0) continue;
    std::uint64_t now_above = 0;
    for (unsigned y = 0; y < kBlockSide; ++y) {
      const unsigned shift = y * kBlockSide;
      const auto hits = static_cast<unsigned>(hit.slices[z] >> shift & 0xFF);
      const auto misses = static_cast<unsigned>(miss.slices[z] >> shift & 0xFF);
      if ((hits | misses) == 0) continue;
      std::int16_t* cells = &log_odds[z * kBlockSide * kBlockSide + y * kBlockSide];
      Row row;
      std::memcpy(&row, cells, sizeof row);
      // No overflow: the limits in validate() keep |log-odds| and |step| below 8.
      Row next = row + (spread(hits) & hit_step) + (spread(misses) & miss_step);
      next = next < low ? low : next;
      next = next > high ? high : next;
      const Row moved = spread(hits | misses);
      row = (next & moved) | (row & ~moved);
      std::memcpy(cells, &row, sizeof row);
      now_above |= std::uint64_t{gather(row >= threshold)} << shift;
    }
    above.slices[z] = (above.slices[z] & ~stepped) | (now_above & stepped);
  }
}

UpdateResult VoxelMap::apply(std::span<const BlockUpdate> updates) {
  struct Outcome {
    bool changed = false;
    int stepped = 0, observed = 0, occupied = 0, roi = 0;
  };
  // Storage first, on one thread and in the order given: slots never depend on the schedule.
  std::vector<std::uint32_t> slots(updates.size());
  for (std::size_t i = 0; i < updates.size(); ++i) {
    const bool with_roi = updates[i].roi_hit.any() || updates[i].roi_miss.any();
    slots[i] = slot_for(updates[i].key, with_roi);
  }
  ++updates_;
  std::vector<Outcome> outcomes(updates.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, updates.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const BlockUpdate& update = updates[i];
      std::uint8_t& summary = directory_.summary(update.key);
      if ((summary & BlockSummary::kSettled) != 0 && !update.hit.any() && !update.roi_hit.any() &&
          !update.roi_miss.any()) {
        outcomes[i].stepped = update.miss.count();  // and nothing moved
        continue;
      }
      BlockMasks& masks = masks_[slots[i]];
      const BlockMasks before = masks;
      VoxelMask stepped = update.hit;
      stepped |= update.miss;
      masks.observed |= stepped;
      add_log_odds(log_odds_[slots[i]], update.hit, update.miss, steps_, masks.occupied);
      if (roi_slots_[slots[i]] != kNoRoi) {
        add_log_odds(roi_log_odds_[roi_slots_[slots[i]]], update.roi_hit, update.roi_miss, steps_,
                     masks.roi);
      }
      const bool changed = !(masks.observed == before.observed &&
                             masks.occupied == before.occupied && masks.roi == before.roi);
      outcomes[i].stepped = stepped.count();
      if (changed) summary = summary_of(masks);
      // Space seen free again and again moves no more: from then on it costs nothing.
      summary &= static_cast<std::uint8_t>(~BlockSummary::kSettled);
      if (update.miss.full() && settled(log_odds_[slots[i]])) summary |= BlockSummary::kSettled;
      if (!changed) continue;
      outcomes[i].changed = true;
      versions_[slots[i]] = updates_;
      outcomes[i].observed = masks.observed.count() - before.observed.count();
      outcomes[i].occupied = masks.occupied.count() - before.occupied.count();
      outcomes[i].roi = masks.roi.count() - before.roi.count();
    }
  });
  UpdateResult result;
  for (std::size_t i = 0; i < updates.size(); ++i) {
    result.updated_voxels += outcomes[i].stepped;
    result.newly_known += outcomes[i].observed;
    occupied_voxels_ += outcomes[i].occupied;
    roi_voxels_ += outcomes[i].roi;
    if (outcomes[i].changed) result.changed.push_back(updates[i].key);
  }
  observed_voxels_ += result.newly_known;
  std::sort(result.changed.begin(), result.changed.end());
  return result;
}

void VoxelMap::write_log_odds(const VoxelIndex& voxel, double log_odds, bool roi) {
  const std::uint32_t slot = slot_for(block_key(voxel), roi);
  BlockMasks& masks = masks_[slot];
  const double clamped =
      std::clamp(log_odds, steps_.min / kFixedPointScale, steps_.max / kFixedPointScale);
  const FixedPoint value = to_fixed_point(clamped);
  const auto z = static_cast<std::size_t>(VoxelMask::slice_of(voxel));
  const std::uint64_t bit = VoxelMask::bit_of(voxel);
  VoxelMask& above = roi ? masks.roi : masks.occupied;
  std::int64_t& above_count = roi ? roi_voxels_ : occupied_voxels_;
  (roi ? roi_log_odds_[roi_slots_[slot]] : log_odds_[slot])[voxel_offset(voxel)] = value;
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
  directory_.summary(block_key(voxel)) = summary_of(masks);
  versions_[slot] = ++updates_;
}

void VoxelMap::set_occupancy_log_odds(const VoxelIndex& voxel, double log_odds) {
  write_log_odds(voxel, log_odds, false);
}

void VoxelMap::set_roi_log_odds(const VoxelIndex& voxel, double log_odds) {
  write_log_odds(voxel, log_odds, true);
}

}  // namespace canopeer
