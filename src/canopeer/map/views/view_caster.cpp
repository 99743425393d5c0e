#include "canopeer/map/views/view_caster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

constexpr VoxelMask kNothing{};
constexpr BlockMasks kNoMasks{};
constexpr VoxelMask kEverything = VoxelMask::all();

// How many of a ray's voxels make up `max_unknown_m`: rays cross more of them along a diagonal.
std::size_t unknown_voxels(std::size_t voxels, double length_m, double max_unknown_m) {
  if (max_unknown_m >= length_m) return voxels;
  const double share = static_cast<double>(voxels) * max_unknown_m / length_m;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(share)));
}

// Without a branch.
template <typename T>
const T* choose(bool first, const T* a, const T* b) {
  const auto of_a = reinterpret_cast<std::uintptr_t>(a), of_b = reinterpret_cast<std::uintptr_t>(b);
  return reinterpret_cast<const T*>(of_b ^ ((of_a ^ of_b) & (std::uintptr_t{0} - first)));
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
    : map_(map),
      all_(all),
      has_bmi2_(simd >= SimdLevel::avx2),
      start_rays_(start_rays_kernel(simd)),
      walk_rays_(walk_rays_kernel(simd)),
      collect_unknown_(collect_unknown_kernel(simd)),
      memory_(scratch()) {
  // A voxel to spare on each side, for rounding.
  const Vec3 spare = Vec3::Constant(map.resolution_m());
  first_key_ = block_key(voxel_at(world.min() - spare, map.resolution_m()));
  first_block_ = block_index(first_key_);
  const VoxelIndex last = block_index(block_key(voxel_at(world.max() + spare, map.resolution_m())));
  blocks_ = last - first_block_ + VoxelIndex::Ones();
  const auto cells = static_cast<std::size_t>(blocks_.cast<std::int64_t>().prod());
  memory_.number.assign(cells, kNew);
  memory_.entered.assign((cells + 63) / 64, 0);
  memory_.stops.clear();
  const auto chunk_index = [](const VoxelIndex& block) {
    return VoxelIndex(block.unaryExpr([](int b) { return b >> BlockDirectory::kChunkShift; }));
  };
  chunks_ = chunk_index(last) - chunk_index(first_block_) + VoxelIndex::Ones();
  memory_.chunks.assign(static_cast<std::size_t>(chunks_.cast<std::int64_t>().prod()), nullptr);
}

void ViewCaster::cast(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m) {
  while (!ends.empty()) {
    const std::size_t count = std::min(ends.size(), RayLanes::kCount);
    cast_together(from, ends.first(count), max_unknown_m);
    ends = ends.subspan(count);
  }
}

void ViewCaster::make_room(std::size_t voxels) {
  const std::size_t steps = (voxels + 7) / 8 * 8;
  const std::size_t most_blocks = RayLanes::kCount * steps;
  if (memory_.at.size() < steps) {
    memory_.at.resize(steps);
    memory_.run.resize(steps);
    memory_.slice.resize(steps * RayLanes::kCount);
    memory_.leaves_slice.resize(steps);
    memory_.leaves_block.resize(steps);
    memory_.slice_ends.resize(RayLanes::kCount * (steps / 64 + 1));
    memory_.block_ends.resize(RayLanes::kCount * (steps / 64 + 1));
    memory_.way.resize(most_blocks);
  }
  const std::size_t met = met_ + most_blocks + 2;
  if (memory_.met.size() < met) memory_.met.resize(2 * met);
}

// The last voxel ends a run, and nothing comes after it.
CANOPEER_KERNEL_BODY void ViewCaster::close_row(std::size_t lane, std::size_t voxels,
                                                std::size_t words) {
  const std::size_t last = (voxels - 1) / 64;
  const std::uint64_t end = std::uint64_t{1} << ((voxels - 1) % 64);
  for (auto* rows : {&memory_.slice_ends, &memory_.block_ends}) {
    std::uint64_t* const row = rows->data() + lane * words;
    row[last] = (row[last] & (end - 1)) | end;
    for (std::size_t word = last + 1; word < words; ++word) row[word] = 0;
  }
}

// All blocks a ray could come to; returns how many they are. No branch on what is new: it would be
// mispredicted.
CANOPEER_KERNEL_BODY std::size_t ViewCaster::find_way(std::size_t lane, std::size_t words,
                                                      MetBlock** way) {
  const std::uint64_t* const ends = memory_.block_ends.data() + lane * words;
  const PackedVoxel* at = &memory_.at.front().items[lane];
  MetBlock* const blocks = memory_.met.data();
  std::uint32_t* const numbers = memory_.number.data();
  const auto row = static_cast<std::uint32_t>(blocks_.x());
  const auto layer = static_cast<std::uint32_t>(blocks_.x() * blocks_.y());
  MetBlock** const begin = way;
  std::uint32_t met = met_;
  for (std::size_t word = 0; word < words; ++word, at += 64 * RayLanes::kCount) {
    for (std::uint64_t bits = ends[word]; bits != 0; bits &= bits - 1) {
      const auto step = static_cast<std::size_t>(std::countr_zero(bits));
      const BlockKey place = packed_voxel::block_of(at[step * RayLanes::kCount]);
      const std::uint32_t cell = packed_voxel::field<0>(place) +
                                 packed_voxel::field<1>(place) * row +
                                 packed_voxel::field<2>(place) * layer;
      blocks[met + 1].place = place;
      blocks[met + 1].cell = cell;
      const std::uint32_t before = numbers[cell];
      const std::uint32_t is_new = before == kNew ? 1 : 0;
      met += is_new;
      const std::uint32_t number = before | (met & (0 - is_new));
      numbers[cell] = number;
      *way++ = blocks + number;
    }
  }
  met_ = met;
  return static_cast<std::size_t>(way - begin);
}

// The blocks numbered since the last time. No branch on what they are: it would be mispredicted.
CANOPEER_KERNEL_BODY void ViewCaster::look_up_new() {
  static const BlockDirectory::Chunk kEmpty;
  constexpr int kShift = BlockDirectory::kChunkShift;
  constexpr unsigned kRelevant = BlockSummary::kComplete | BlockSummary::kOccupied;
  const bool some = map_.observed_voxels() != 0;  // so there is a slot 0
  const BlockKey in_chunk = first_key_ - BlockDirectory::chunk_key(first_key_);
  const auto row = static_cast<std::uint32_t>(chunks_.x());
  const auto layer = static_cast<std::uint32_t>(chunks_.x() * chunks_.y());
  const BlockDirectory::Chunk** const chunks = memory_.chunks.data();
  MetBlock* const end = memory_.met.data() + met_ + 1;
  for (MetBlock* block = memory_.met.data() + looked_up_ + 1; block != end; ++block) {
    const BlockKey place = block->place + in_chunk;  // from the first chunk's first block
    const std::uint32_t cell = (packed_voxel::field<0>(place) >> kShift) +
                               (packed_voxel::field<1>(place) >> kShift) * row +
                               (packed_voxel::field<2>(place) >> kShift) * layer;
    if (chunks[cell] == nullptr) [[unlikely]] {
      chunks[cell] = map_.chunk(first_key_ + block->place);
      if (chunks[cell] == nullptr) chunks[cell] = &kEmpty;
    }
    const BlockDirectory::Chunk& chunk = *chunks[cell];
    const std::size_t in = BlockDirectory::place_in_chunk(place);
    const unsigned summary = chunk.summaries[in];
    const std::uint32_t slot = chunk.slots[in];
    const bool there = slot != BlockDirectory::kFree;
    const bool clear = !all_ & ((summary & kRelevant) == BlockSummary::kComplete);
    const bool stops = (summary & BlockSummary::kOccupied) != 0;
    const BlockMasks* const known =
        some ? &map_.block_in_slot(slot & (0 - std::uint32_t{there})) : &kNoMasks;
    block->observed = choose(clear, &kEverything, choose(there, &known->observed, &kNothing));
    block->occupied = choose(stops, &known->occupied, &kNothing);
    block->known = choose<BlockMasks>(there, known, nullptr);
    block->crossed = {};
    fetch_early(*block->observed);
    fetch_early(*block->occupied);
  }
  looked_up_ = met_;
}

// Slice by slice, up to the end or to where something stops the ray. Clear blocks are not told from
// the others: nothing is new or in the way there. kLimited: it may end for crossing too much
// unknown space.
template <bool kLimited>
CANOPEER_KERNEL_BODY void ViewCaster::follow(std::size_t lane, std::size_t words,
                                             MetBlock* const* way, std::size_t unknown_left) {
  const std::uint64_t* const slice_ends = memory_.slice_ends.data() + lane * words;
  const std::uint64_t* const block_ends = memory_.block_ends.data() + lane * words;
  const std::uint64_t* runs = &memory_.run.front().items[lane];
  const std::uint8_t* slices = &memory_.slice[lane];
  MetBlock* const* block = way;
  bool ends = false;
  for (std::size_t word = 0; word < words && !ends; ++word) {
    const std::uint64_t leaves = block_ends[word];
    for (std::uint64_t bits = slice_ends[word]; bits != 0; bits &= bits - 1) {
      const auto step = static_cast<std::size_t>(std::countr_zero(bits));
      const std::uint64_t run = runs[step * RayLanes::kCount];
      const std::size_t slice = slices[step * RayLanes::kCount];
      MetBlock& here = **block;
      bool stops = (run & here.occupied->slices[slice]) != 0;
      if constexpr (kLimited) {
        const auto count =
            static_cast<std::size_t>(std::popcount(run & ~here.observed->slices[slice]));
        stops |= count >= unknown_left;
        unknown_left -= stops ? 0 : count;
      }
      if (stops) [[unlikely]] {
        end_in_run(lane, 64 * word + step, here, unknown_left);
        ++block;
        ends = true;
        break;
      }
      here.crossed.slices[slice] |= run;
      block += leaves >> step & 1;
    }
    runs += 64 * RayLanes::kCount;
    slices += 64 * RayLanes::kCount;
  }
  std::uint64_t* const entered = memory_.entered.data();
  for (; way != block; ++way) entered[(*way)->cell >> 6] |= std::uint64_t{1} << ((*way)->cell & 63);
}

CANOPEER_KERNEL_BODY void ViewCaster::cast_body(const Vec3& from, std::span<const Vec3> ends,
                                                double max_unknown_m) {
  std::array<Ray, RayLanes::kCount> rays;
  std::size_t most = 0, least = std::numeric_limits<std::size_t>::max();
  start_rays_(from, ends, map_.resolution_m(), first_block_ * kBlockSide, memory_.lanes);
  for (std::size_t lane = 0; lane < ends.size(); ++lane) {
    const std::size_t voxels = static_cast<std::size_t>(memory_.lanes.steps[lane]) + 1;
    rays[lane] = {voxels, unknown_voxels(voxels, (ends[lane] - from).norm(), max_unknown_m)};
    most = std::max(most, voxels);
    least = std::min(least, voxels);
  }
  if (most > 64 * least) {  // they cannot go together
    for (const Vec3& end : ends) cast_together(from, std::span(&end, 1), max_unknown_m);
    return;
  }
  make_room(most);
  walk_rays_(
      memory_.lanes, most,
      {memory_.at.front().items.data(), memory_.slice.data(), memory_.run.front().items.data(),
       memory_.leaves_slice.data(), memory_.leaves_block.data()});
  turn_to_rows(memory_.leaves_slice.data(), most, memory_.slice_ends.data());
  const std::size_t words =
      turn_to_rows(memory_.leaves_block.data(), most, memory_.block_ends.data());
  // All blocks the rays could come to, before any is followed: their memory is fetched meanwhile.
  std::array<MetBlock**, RayLanes::kCount> ways;
  MetBlock** next = memory_.way.data();
  for (std::size_t lane = 0; lane < ends.size(); ++lane) {
    close_row(lane, rays[lane].voxels, words);
    ways[lane] = next;
    next += find_way(lane, words, next);
  }
  look_up_new();
  for (std::size_t lane = 0; lane < ends.size(); ++lane) {
    const std::size_t left = rays[lane].unknown_left;
    if (left < rays[lane].voxels) {
      follow<true>(lane, words, ways[lane], left);
    } else {
      follow<false>(lane, words, ways[lane], left);
    }
  }
}

CANOPEER_TARGET_BMI2 void ViewCaster::cast_with_bmi2(const Vec3& from, std::span<const Vec3> ends,
                                                     double max_unknown_m) {
  cast_body(from, ends, max_unknown_m);
}

void ViewCaster::cast_plain(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m) {
  cast_body(from, ends, max_unknown_m);
}

void ViewCaster::cast_together(const Vec3& from, std::span<const Vec3> ends, double max_unknown_m) {
  has_bmi2_ ? cast_with_bmi2(from, ends, max_unknown_m) : cast_plain(from, ends, max_unknown_m);
}

// The run up to `step`, voxel by voxel: somewhere here the ray may end.
void ViewCaster::end_in_run(std::size_t lane, std::size_t step, MetBlock& block,
                            std::size_t unknown_left) {
  const std::size_t slice = memory_.slice[step * RayLanes::kCount + lane];
  const std::uint64_t observed = block.observed->slices[slice];
  const std::uint64_t occupied = block.occupied->slices[slice];
  std::uint64_t& crossed = block.crossed.slices[slice];
  std::size_t begin = step;
  while (begin > 0 && (memory_.leaves_slice[begin - 1] >> lane & 1) == 0) --begin;
  std::uint64_t before = 0;
  for (std::size_t i = begin; i <= step; ++i) {
    const std::uint64_t bit = memory_.run[i].items[lane] & ~before;
    before |= bit;
    if ((occupied & bit) != 0) {
      if (all_) stop_at(block, slice, bit);
      return;
    }
    crossed |= bit;
    unknown_left -= (observed & bit) == 0 ? 1 : 0;
    if (unknown_left == 0) return;
  }
}

void ViewCaster::stop_at(const MetBlock& block, std::size_t slice, std::uint64_t bit) {
  const auto number = static_cast<std::size_t>(&block - memory_.met.data());
  if (memory_.stops.size() <= number) memory_.stops.resize(met_ + 1);
  memory_.stops[number].slices[slice] |= bit;
}

}  // namespace canopeer
