#include "canopeer/map/view_caster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace canopeer {
namespace {

constexpr VoxelMask kNothing{};
constexpr VoxelMask kEverything = VoxelMask::all();

BlockKey key_of(const VoxelIndex& block) { return pack_block(block.x(), block.y(), block.z()); }

// How many voxels of this walk make up `max_unknown_m`: rays cross more of them along a diagonal.
std::size_t unknown_voxels(const VoxelWalk& walk, double length_m, double max_unknown_m) {
  const double all = walk.steps + 1.0;
  return static_cast<std::size_t>(
      max_unknown_m < length_m ? std::max(1.0, std::ceil(all * max_unknown_m / length_m)) : all);
}

void fetch_early([[maybe_unused]] const VoxelMask& mask) {
#if defined(__GNUC__)
  // A mask lies in one or two cache lines.
  __builtin_prefetch(&mask.slices.front());
  __builtin_prefetch(&mask.slices.back());
#endif
}

}  // namespace

ViewCaster::Scratch& ViewCaster::scratch() {
  thread_local Scratch scratch;
  return scratch;
}

ViewCaster::ViewCaster(const VoxelMap& map, const Box& world, bool all, SimdLevel simd)
    : map_(map), all_(all), walk_rays_(walk_rays_kernel(simd)), memory_(scratch()) {
  // A voxel to spare on each side, for rounding.
  const Vec3 spare = Vec3::Constant(map.resolution_m());
  first_block_ = block_index(block_key(voxel_at(world.min() - spare, map.resolution_m())));
  const VoxelIndex last = block_index(block_key(voxel_at(world.max() + spare, map.resolution_m())));
  blocks_ = last - first_block_ + VoxelIndex::Ones();
  const auto cells = static_cast<std::size_t>(blocks_.cast<std::int64_t>().prod());
  memory_.number.assign(cells, kNew);
  memory_.entered.assign((cells + 63) / 64, 0);
  memory_.stops.clear();
}

void ViewCaster::cast(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m) {
  while (!ends.empty()) {
    const std::size_t count = std::min(ends.size(), RayLanes::kCount);
    cast_together(from, ends.first(count), max_unknown_m);
    ends = ends.subspan(count);
  }
}

void ViewCaster::cast_together(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m) {
  std::array<Ray, RayLanes::kCount> rays;
  std::size_t most = 0, least = std::numeric_limits<std::size_t>::max();
  for (std::size_t lane = 0; lane < RayLanes::kCount; ++lane) {
    const Vec3& end = ends[std::min(lane, ends.size() - 1)];
    const VoxelWalk walk(from, end, map_.resolution_m());
    memory_.lanes.set(lane, walk, first_block_ * kBlockSide);
    rays[lane].voxels = static_cast<std::size_t>(walk.steps) + 1;
    rays[lane].unknown_left = unknown_voxels(walk, (end - from).norm(), max_unknown_m);
    most = std::max(most, rays[lane].voxels);
    least = std::min(least, rays[lane].voxels);
  }
  if (most > 64 * least) {  // they cannot go together
    for (const Vec3& end : ends) cast_together(from, std::span(&end, 1), max_unknown_m);
    return;
  }
  make_room(most);
  walk_rays_(memory_.lanes, most,
             {memory_.at.front().items.data(), memory_.offset.front().items.data(),
              memory_.enters.data()});
  const std::size_t words = turn_enters(memory_.enters.data(), most, memory_.turned.data());
  // All blocks the rays could come to, before any is followed: their memory is fetched meanwhile.
  std::array<std::span<const OnTheWay>, RayLanes::kCount> ways;
  OnTheWay* next = memory_.way.data();
  for (std::size_t lane = 0; lane < ends.size(); ++lane) {
    const std::size_t blocks = find_way(lane, rays[lane].voxels, words, next);
    ways[lane] = {next, blocks};
    next += blocks + 1;
  }
  look_up_new();
  for (std::size_t lane = 0; lane < ends.size(); ++lane) follow(lane, ways[lane], rays[lane]);
}

void ViewCaster::make_room(std::size_t voxels) {
  const std::size_t steps = (voxels + 7) / 8 * 8;
  const std::size_t most_blocks = RayLanes::kCount * (steps + 1);
  if (memory_.at.size() < steps) {
    memory_.at.resize(steps);
    memory_.offset.resize(steps / 4 + 1);
    memory_.enters.resize(steps);
    memory_.turned.resize(RayLanes::kCount * (steps / 64 + 1));
    memory_.way.resize(most_blocks);
  }
  const std::size_t met = met_ + most_blocks + 1;
  if (memory_.keys.size() < met) {
    memory_.keys.resize(2 * met);
    memory_.seen.resize(2 * met);
    memory_.crossed.resize(2 * met);
  }
}

// All blocks a ray could come to. Returns how many they are; one more says where the last one ends.
// No branch on what is new: it would be mispredicted.
std::size_t ViewCaster::find_way(std::size_t lane, std::size_t voxels, std::size_t words,
                                 OnTheWay* way) {
  const std::uint64_t* const enters = memory_.turned.data() + lane * words;
  const RayLanes::Row<PackedVoxel>* const at = memory_.at.data();
  BlockKey* const keys = memory_.keys.data();
  std::uint32_t* const numbers = memory_.number.data();
  const BlockKey first = key_of(first_block_);
  const auto row = static_cast<std::uint32_t>(blocks_.x());
  const auto layer = static_cast<std::uint32_t>(blocks_.x() * blocks_.y());
  std::uint32_t met = met_;
  std::size_t blocks = 0;
  for (std::size_t word = 0; 64 * word < voxels; ++word) {
    std::uint64_t bits = enters[word];
    if (voxels - 64 * word < 64) bits &= (std::uint64_t{1} << (voxels - 64 * word)) - 1;
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t step = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
      const BlockKey block = packed_voxel::block_of(at[step].items[lane]);
      const std::uint32_t cell = packed_voxel::field<0>(block) +
                                 packed_voxel::field<1>(block) * row +
                                 packed_voxel::field<2>(block) * layer;
      keys[met + 1] = first + block;
      const std::uint32_t before = numbers[cell];
      met += before == kNew ? 1 : 0;
      const std::uint32_t number = before == kNew ? met : before;
      numbers[cell] = number;
      way[blocks++] = {static_cast<std::uint32_t>(step), cell, number};
    }
  }
  met_ = met;
  way[blocks].step = static_cast<std::uint32_t>(voxels);
  return blocks;
}

// The blocks numbered since the last time.
void ViewCaster::look_up_new() {
  for (; looked_up_ < met_; ++looked_up_) {
    const std::uint32_t number = looked_up_ + 1;
    const Seen seen = look_up(memory_.keys[number]);
    fetch_early(*seen.observed);
    fetch_early(*seen.occupied);
    memory_.seen[number] = seen;
    memory_.crossed[number] = {};
  }
}

ViewCaster::Seen ViewCaster::look_up(BlockKey key) {
  if (BlockDirectory::chunk_key(key) != chunk_key_) {
    chunk_key_ = BlockDirectory::chunk_key(key);
    chunk_ = map_.chunk(key);
  }
  const Seen unknown{&kNothing, &kNothing, nullptr};
  if (chunk_ == nullptr) return unknown;
  const std::size_t place = BlockDirectory::place_in_chunk(key);
  const unsigned summary = chunk_->summaries[place];
  constexpr unsigned kRelevant = BlockSummary::kComplete | BlockSummary::kOccupied;
  if (!all_ && (summary & kRelevant) == BlockSummary::kComplete) {
    return {&kEverything, &kNothing, nullptr};
  }
  if (chunk_->slots[place] == BlockDirectory::kFree) return unknown;
  const BlockMasks& known = map_.block_in_slot(chunk_->slots[place]);
  const bool stops = (summary & BlockSummary::kOccupied) != 0;
  return {&known.observed, stops ? &known.occupied : &kNothing, &known};
}

void ViewCaster::follow(std::size_t lane, std::span<const OnTheWay> way, Ray ray) {
  const std::uint16_t* const offsets = memory_.offset.front().items.data() + lane;
  for (const OnTheWay& block : way) {
    memory_.entered[block.cell >> 6] |= std::uint64_t{1} << (block.cell & 63);
    if (memory_.seen[block.number].observed == &kEverything) continue;
    const std::uint32_t end = (&block + 1)->step;  // the last one has one behind it
    if (!walk_in_block(block.number, offsets + block.step * RayLanes::kCount, end - block.step,
                       ray.unknown_left)) {
      return;
    }
  }
}

// False: the ray ends here.
bool ViewCaster::walk_in_block(std::uint32_t number, const std::uint16_t* offsets,
                               std::size_t voxels, std::size_t& unknown_left) {
  const VoxelMask& observed = *memory_.seen[number].observed;
  const VoxelMask& occupied = *memory_.seen[number].occupied;
  VoxelMask& crossed = memory_.crossed[number];
  std::size_t left = unknown_left;
  for (std::size_t i = 0; i < voxels; ++i) {
    const std::size_t offset = offsets[i * RayLanes::kCount];
    const std::size_t slice = offset >> 6;
    const std::uint64_t bit = std::uint64_t{1} << (offset & 63);
    if ((occupied.slices[slice] & bit) != 0) {
      if (all_) stop_at(number, slice, bit);
      return false;
    }
    crossed.slices[slice] |= bit;
    left -= (observed.slices[slice] & bit) == 0;
    if (left == 0) return false;
  }
  unknown_left = left;
  return true;
}

void ViewCaster::stop_at(std::uint32_t number, std::size_t slice, std::uint64_t bit) {
  if (memory_.stops.size() <= number) memory_.stops.resize(met_ + 1);
  memory_.stops[number].slices[slice] |= bit;
}

// Cell order is key order.
std::span<const std::uint32_t> ViewCaster::entered() const {
  memory_.in_order.resize(met_);
  std::uint32_t* const in_order = memory_.in_order.data();
  std::size_t count = 0;
  const std::uint32_t* number = memory_.number.data();
  for (const std::uint64_t word : memory_.entered) {
    for (std::uint64_t bits = word; bits != 0; bits &= bits - 1) {
      in_order[count++] = number[std::countr_zero(bits)];
    }
    number += 64;
  }
  return {in_order, count};
}

ViewCast ViewCaster::result() const {
  const std::span<const std::uint32_t> numbers = entered();
  ViewCast cast;
  cast.touched.resize(numbers.size());
  memory_.found.resize(std::max(memory_.found.size(), numbers.size() + 1));
  std::size_t found = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const BlockKey key = memory_.keys[numbers[i]];
    const VoxelMask& crossed = memory_.crossed[numbers[i]];
    const VoxelMask& observed = *memory_.seen[numbers[i]].observed;
    VoxelSet::Block& block = memory_.found[found];
    std::uint64_t any = 0;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t unknown = crossed.slices[z] & ~observed.slices[z];
      block.mask.slices[z] = unknown;
      any |= unknown;
    }
    block.key = key;
    cast.touched[i] = key;
    found += any != 0 ? 1 : 0;  // no branch: it would be mispredicted
  }
  const auto first = memory_.found.begin();
  cast.unknown = VoxelSet::of_sorted({first, first + static_cast<std::ptrdiff_t>(found)});
  return cast;
}

SeenVoxels ViewCaster::all() const {
  SeenVoxels seen;
  std::vector<VoxelSet::Block> unknown, free, occupied, roi;
  for (const std::uint32_t number : entered()) {
    const BlockKey key = memory_.keys[number];
    const VoxelMask& crossed = memory_.crossed[number];
    seen.touched.push_back(key);
    VoxelMask not_known = crossed;
    if (const BlockMasks* masks = memory_.seen[number].known; masks != nullptr) {
      not_known -= masks->observed;
      VoxelMask known = crossed;
      known &= masks->observed;
      free.push_back({key, known});
      const VoxelMask stops = number < memory_.stops.size() ? memory_.stops[number] : VoxelMask{};
      occupied.push_back({key, stops});
      VoxelMask fruit = crossed;
      fruit |= stops;
      fruit &= masks->roi;
      roi.push_back({key, fruit});
    }
    unknown.push_back({key, not_known});
  }
  seen.unknown = VoxelSet(std::move(unknown));
  seen.free = VoxelSet(std::move(free));
  seen.occupied = VoxelSet(std::move(occupied));
  seen.roi = VoxelSet(std::move(roi));
  return seen;
}

}  // namespace canopeer
