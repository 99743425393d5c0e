#include "canopeer/map/voxel_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

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
  const FixedPoint value =
      block.log_odds == kNone ? block.uniform : log_odds_[block.log_odds][voxel_offset(voxel)];
  return value / kFixedPointScale;
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

std::uint32_t VoxelMap::new_log_odds(FixedPoint value) {
  BlockLogOdds cells;
  cells.fill(value);
  if (unused_log_odds_.empty()) return static_cast<std::uint32_t>(log_odds_.push_back(cells));
  const std::uint32_t place = unused_log_odds_.back();
  unused_log_odds_.pop_back();
  log_odds_.own(place) = cells;
  return place;
}

std::uint32_t VoxelMap::own_log_odds(Block& block) {
  if (block.log_odds == kNone) {
    block.log_odds = new_log_odds(block.uniform);
  } else {
    log_odds_.own(block.log_odds);
  }
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

// Storage is taken on one thread and in the order given: slots never depend on the schedule.
VoxelMap::Place VoxelMap::place_for(const BlockUpdate& update, BlockDirectory::Chunk& chunk) {
  const std::size_t in_chunk = BlockDirectory::place_in_chunk(update.key);
  Place place;
  place.slot = slot_for(chunk, in_chunk, update.key);
  place.summary = &chunk.summaries[in_chunk];
  const bool with_roi = update.roi_hit.any() || update.roi_miss.any();
  place.settled = (*place.summary & BlockSummary::kSettled) != 0 && !update.hit.any() && !with_roi;
  if (place.settled) return place;
  Block& block = blocks_.own(place.slot);
  masks_.own(place.slot);
  own_log_odds(block);
  if (with_roi) own_roi_log_odds(block);
  return place;
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
  Outcome outcome;
  if (place.settled) {
    outcome.stepped = update.miss.count();
    return outcome;
  }
  Block& block = blocks_.owned(place.slot);
  BlockMasks& masks = masks_.owned(place.slot);
  const BlockMasks before = masks;
  VoxelMask stepped = update.hit;
  stepped |= update.miss;
  masks.observed |= stepped;
  kernels.step(log_odds_.owned(block.log_odds).data(), update.hit, update.miss, steps_,
               masks.occupied);
  if (update.roi_hit.any() || update.roi_miss.any()) step_roi(update, block, kernels, masks.roi);
  outcome.stepped = stepped.count();
  *place.summary &= static_cast<std::uint8_t>(~BlockSummary::kSettled);
  outcome.changed = !(masks.observed == before.observed && masks.occupied == before.occupied &&
                      masks.roi == before.roi);
  if (!outcome.changed) return outcome;
  *place.summary = summary_of(masks);
  block.version = updates_;
  outcome.observed = masks.observed.count() - before.observed.count();
  outcome.occupied = masks.occupied.count() - before.occupied.count();
  outcome.roi = masks.roi.count() - before.roi.count();
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
  Outcome outcome;
  outcome.stepped = kBlockVoxels;
  outcome.uniform = range.min == range.max;
  block.uniform = range.min;
  outcome.changed = !(masks.observed == before.observed && masks.occupied == before.occupied);
  *place.summary = static_cast<std::uint8_t>(
      summary_of(masks) |
      (outcome.uniform && range.min == steps_.min ? BlockSummary::kSettled : 0));
  if (!outcome.changed) return outcome;
  block.version = updates_;
  outcome.observed = masks.observed.count() - before.observed.count();
  outcome.occupied = masks.occupied.count() - before.occupied.count();
  return outcome;
}

// A miss for every voxel of a block that has one value for all, or is new. False: it is neither.
bool VoxelMap::apply_uniform(BlockDirectory::Chunk& chunk, std::size_t in_chunk, BlockKey key,
                             UpdateResult& result) {
  std::uint8_t& summary = chunk.summaries[in_chunk];
  if ((summary & BlockSummary::kSettled) == 0) {
    const std::uint32_t slot = slot_for(chunk, in_chunk, key);
    if (blocks_[slot].log_odds != kNone) return false;
    Block& block = blocks_.own(slot);
    const bool is_new = (summary & BlockSummary::kComplete) == 0;
    const bool was_occupied = (summary & BlockSummary::kOccupied) != 0;
    block.uniform =
        std::max<FixedPoint>(static_cast<FixedPoint>(block.uniform + steps_.miss), steps_.min);
    const bool occupied = block.uniform >= steps_.threshold;
    if (is_new || occupied != was_occupied) {
      BlockMasks& masks = masks_.own(slot);
      masks.observed = VoxelMask::all();
      masks.occupied = occupied ? VoxelMask::all() : VoxelMask{};
      summary = summary_of(masks);
      block.version = updates_;
      result.newly_known += is_new ? kBlockVoxels : 0;
      occupied_voxels_ += kBlockVoxels * (int{occupied} - int{was_occupied});
      result.changed.push_back(key);
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

UpdateResult VoxelMap::apply(std::span<const BlockUpdate> updates,
                             std::span<const BlockKey> all_free, SimdLevel simd) {
  const LogOddsKernels& kernels = log_odds_kernels(simd);
  ++updates_;
  UpdateResult result;
  BlockDirectory::Chunk* chunk = nullptr;
  BlockKey chunk_key = ~BlockKey{0};
  const auto chunk_of = [&](BlockKey key) -> BlockDirectory::Chunk& {
    if (BlockDirectory::chunk_key(key) != chunk_key) {
      chunk_key = BlockDirectory::chunk_key(key);
      chunk = &directory_.chunk_to_write(key);
    }
    return *chunk;
  };
  std::vector<Place> places;
  places.reserve(updates.size());
  for (const BlockUpdate& update : updates) {
    places.push_back(place_for(update, chunk_of(update.key)));
  }
  std::vector<Place> freed;  // blocks all free that have log-odds of their own
  for (const BlockKey key : all_free) {
    BlockDirectory::Chunk& here = chunk_of(key);
    const std::size_t in_chunk = BlockDirectory::place_in_chunk(key);
    if (apply_uniform(here, in_chunk, key, result)) continue;
    Place& place = freed.emplace_back();
    place.slot = here.slots[in_chunk];
    place.summary = &here.summaries[in_chunk];
    masks_.own(place.slot);
    log_odds_.own(blocks_.own(place.slot).log_odds);
  }
  std::vector<Outcome> outcomes(updates.size() + freed.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, outcomes.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          outcomes[i] = i < updates.size() ? apply(updates[i], places[i], kernels)
                                           : apply_all_free(freed[i - updates.size()], kernels);
        }
      });
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    count(outcomes[i], i < updates.size() ? places[i].slot : freed[i - updates.size()].slot,
          result);
  }
  observed_voxels_ += result.newly_known;
  std::sort(result.changed.begin(), result.changed.end());
  return result;
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
       : log_odds_.owned(own_log_odds(block)))[voxel_offset(voxel)] = value;
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
