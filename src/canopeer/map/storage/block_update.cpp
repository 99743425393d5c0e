// What an update does to one block of the map.

#include <algorithm>

#include "canopeer/map/voxel_map.h"

namespace canopeer {
namespace {

// As ==, which would be a call.
bool alike(const VoxelMask& a, const VoxelMask& b) {
  std::uint64_t differ = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z) differ |= a.slices[z] ^ b.slices[z];
  return differ == 0;
}

}  // namespace

std::uint32_t VoxelMap::slot_for(BlockDirectory::Chunk& chunk, std::size_t place, BlockKey key) {
  const std::uint32_t slot = directory_.find_or_add(chunk, place);
  if (slot == blocks_.size()) {
    Block block;
    block.key = key;
    blocks_.push_back(block);
    masks_.push_back({});
  }
  return slot;
}

VoxelMap::FixedPoint VoxelMap::after_miss(FixedPoint value) const {
  return static_cast<FixedPoint>(std::clamp<int>(value + steps_.miss, steps_.min, steps_.max));
}

// The observed voxels have the block's one value, the others 0.
std::uint32_t VoxelMap::own_log_odds(Block& block, const VoxelMask& observed) {
  if (block.log_odds != kNone) {
    log_odds_.own(block.log_odds);
    return block.log_odds;
  }
  if (unused_log_odds_.empty()) {
    block.log_odds = static_cast<std::uint32_t>(log_odds_.add());
  } else {
    block.log_odds = unused_log_odds_.back();
    unused_log_odds_.pop_back();
  }
  BlockLogOdds& cells = log_odds_.own(block.log_odds);
  log_odds_kernels(best_simd_level()).fill(cells.data(), observed, block.uniform);
  return block.log_odds;
}

std::uint32_t VoxelMap::own_roi_log_odds(Block& block) {
  if (block.roi_log_odds == kNone) {
    block.roi_log_odds = static_cast<std::uint32_t>(roi_log_odds_.push_back(BlockLogOdds{}));
  } else {
    roi_log_odds_.own(block.roi_log_odds);
  }
  return block.roi_log_odds;
}

std::uint8_t VoxelMap::summary_of(const BlockMasks& masks) {
  unsigned summary = 0;
  if (masks.occupied.any()) summary |= BlockSummary::kOccupied;
  if (masks.observed.full()) summary |= BlockSummary::kComplete;
  if (masks.roi.any()) summary |= BlockSummary::kRoi;
  return static_cast<std::uint8_t>(summary);
}

VoxelMap::Outcome VoxelMap::compare(const BlockMasks& before, const BlockMasks& now) {
  Outcome outcome;
  const auto gained = [&](VoxelMask BlockMasks::*kind) {
    const VoxelMask &old = before.*kind, &mask = now.*kind;
    if (alike(old, mask)) return 0;
    outcome.changed = true;
    return mask.count() - old.count();
  };
  outcome.observed = gained(&BlockMasks::observed);
  outcome.occupied = gained(&BlockMasks::occupied);
  outcome.roi = gained(&BlockMasks::roi);
  return outcome;
}

// Misses that leave a block's observed voxels with one value for all: the first ones, the same ones
// again, or others when none was missed more than once. False: they would not.
bool VoxelMap::apply_alike(const VoxelMask& miss, const Place& place, UpdateResult& result) {
  if ((*place.summary & BlockSummary::kSettled) != 0) {  // nothing can move
    result.updated_voxels += miss.count();
    return true;
  }
  if (blocks_[place.slot].log_odds != kNone) return false;
  const FixedPoint first = after_miss(0);
  const VoxelMask& observed = masks_[place.slot].observed;
  FixedPoint value = first;
  bool first_time = true;
  if (observed.any()) {
    VoxelMask again = observed;
    again &= miss;
    value = blocks_[place.slot].uniform;
    if (again.any()) {
      if (!alike(observed, miss)) return false;
      first_time = false;
      value = after_miss(value);
    } else if (value != first) {
      return false;
    }
  }
  Block& block = blocks_.own(place.slot);
  BlockMasks& masks = masks_.own(place.slot);
  block.uniform = value;
  Outcome outcome;
  outcome.stepped = miss.count();
  outcome.observed = first_time ? outcome.stepped : 0;  // all of them, or none
  masks.observed |= miss;
  const VoxelMask occupied = value >= steps_.threshold ? masks.observed : VoxelMask{};
  outcome.changed = first_time && outcome.stepped != 0;
  if (!alike(masks.occupied, occupied)) {
    outcome.changed = true;
    outcome.occupied = occupied.count() - masks.occupied.count();
    masks.occupied = occupied;
  }
  if (outcome.changed) {
    *place.summary = summary_of(masks);
    block.version = updates_;
  }
  count(outcome, place.slot, result);
  return true;
}

// Storage is taken on one thread and in the order given: slots never depend on the schedule.
void VoxelMap::take_storage(const BlockUpdate& update, const Place& place) {
  Block& block = blocks_.own(place.slot);
  own_log_odds(block, masks_.own(place.slot).observed);
  if (update.roi_hit.any() || update.roi_miss.any()) own_roi_log_odds(block);
}

void VoxelMap::step_roi(const BlockUpdate& update, const Block& block,
                        const LogOddsKernels& kernels, VoxelMask& roi) {
  FixedPoint* cells = roi_log_odds_.owned(block.roi_log_odds).data();
  if (update.roi_confidence == nullptr) {
    kernels.step(cells, update.roi_hit, update.roi_miss, steps_, roi);
    return;
  }
  kernels.step(cells, {}, update.roi_miss, steps_, roi);
  for_each_voxel(update.key, update.roi_hit, [&](const VoxelIndex& voxel) {
    VoxelMask one;
    one.set(voxel);
    LogOddsSteps steps = steps_;
    steps.hit = confidence_steps_[update.roi_confidence[voxel_offset(voxel)]];
    log_odds_kernels(SimdLevel::scalar).step(cells, one, {}, steps, roi);
  });
}

VoxelMap::Outcome VoxelMap::apply(const BlockUpdate& update, const Place& place,
                                  const LogOddsKernels& kernels) {
  Block& block = blocks_.owned(place.slot);
  BlockMasks& masks = masks_.owned(place.slot);
  const BlockMasks before = masks;
  VoxelMask stepped = update.hit;
  stepped |= update.miss;
  masks.observed |= stepped;
  kernels.step(log_odds_.owned(block.log_odds).data(), update.hit, update.miss, steps_,
               masks.occupied);
  if (update.roi_hit.any() || update.roi_miss.any()) step_roi(update, block, kernels, masks.roi);
  return finish(before, stepped.count(), place);
}

VoxelMap::Outcome VoxelMap::apply_misses(const VoxelMask& miss, const Place& place,
                                         const LogOddsKernels& kernels) {
  BlockMasks& masks = masks_.owned(place.slot);
  const BlockMasks before = masks;
  masks.observed |= miss;
  kernels.step(log_odds_.owned(blocks_[place.slot].log_odds).data(), {}, miss, steps_,
               masks.occupied);
  return finish(before, miss.count(), place);
}

VoxelMap::Outcome VoxelMap::finish(const BlockMasks& before, int stepped, const Place& place) {
  const BlockMasks& masks = masks_[place.slot];
  *place.summary &= static_cast<std::uint8_t>(~BlockSummary::kSettled);
  Outcome outcome = compare(before, masks);
  outcome.stepped = stepped;
  if (!outcome.changed) return outcome;
  *place.summary = summary_of(masks);
  blocks_.owned(place.slot).version = updates_;
  return outcome;
}

// A miss for every voxel of a block that has log-odds of its own; all of one value, it needs them
// no more.
VoxelMap::Outcome VoxelMap::apply_all_free(const Place& place, const LogOddsKernels& kernels) {
  Block& block = blocks_.owned(place.slot);
  BlockMasks& masks = masks_.owned(place.slot);
  const BlockMasks before = masks;
  BlockLogOdds& cells = log_odds_.owned(block.log_odds);
  const LogOddsRange range = kernels.miss_all(cells.data(), steps_);
  masks.observed = VoxelMask::all();
  if (range.max < steps_.threshold) {
    masks.occupied = {};
  } else {
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const std::uint64_t bit = std::uint64_t{1} << i % 64;
      std::uint64_t& slice = masks.occupied.slices[i / 64];
      slice = cells[i] >= steps_.threshold ? slice | bit : slice & ~bit;
    }
  }
  Outcome outcome = compare(before, masks);
  outcome.stepped = kBlockVoxels;
  outcome.uniform = range.min == range.max;
  block.uniform = range.min;
  *place.summary = static_cast<std::uint8_t>(
      summary_of(masks) |
      (outcome.uniform && range.min == steps_.min ? BlockSummary::kSettled : 0));
  if (outcome.changed) block.version = updates_;
  return outcome;
}

// A miss for every voxel of a block that has one value for all, or is new. False: it is neither.
bool VoxelMap::apply_uniform(const Place& place, UpdateResult& result) {
  std::uint8_t& summary = *place.summary;
  if ((summary & BlockSummary::kSettled) == 0) {
    if (blocks_[place.slot].log_odds != kNone) return false;
    const bool is_new = (summary & BlockSummary::kComplete) == 0;
    if (is_new && masks_[place.slot].observed.any()) return false;
    const bool was_occupied = (summary & BlockSummary::kOccupied) != 0;
    Block& block = blocks_.own(place.slot);
    block.uniform = after_miss(block.uniform);
    const bool occupied = block.uniform >= steps_.threshold;
    if (is_new || occupied != was_occupied) {
      BlockMasks& masks = masks_.own(place.slot);
      masks.observed = VoxelMask::all();
      masks.occupied = occupied ? VoxelMask::all() : VoxelMask{};
      summary = summary_of(masks);
      block.version = updates_;
      result.newly_known += is_new ? kBlockVoxels : 0;
      occupied_voxels_ += std::int64_t{kBlockVoxels} * (int{occupied} - int{was_occupied});
      result.changed.push_back(block.key);
    }
    if (block.uniform == steps_.min) summary |= BlockSummary::kSettled;
  }
  result.updated_voxels += kBlockVoxels;
  return true;
}

void VoxelMap::count(const Outcome& outcome, std::uint32_t slot, UpdateResult& result) {
  result.updated_voxels += outcome.stepped;
  result.newly_known += outcome.observed;
  occupied_voxels_ += outcome.occupied;
  roi_voxels_ += outcome.roi;
  if (outcome.changed) result.changed.push_back(blocks_[slot].key);
  if (outcome.uniform) {
    Block& block = blocks_.owned(slot);
    unused_log_odds_.push_back(block.log_odds);
    block.log_odds = kNone;
  }
}

}  // namespace canopeer
