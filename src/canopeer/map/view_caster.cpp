#include "canopeer/map/view_caster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace canopeer {
namespace {

constexpr VoxelMask kNothing{};

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
  memory_.met.clear();
  memory_.crossed.clear();
  memory_.stops.clear();
}

// A block not met before.
std::uint32_t ViewCaster::number_new(BlockKey key) {
  memory_.met.push_back({key, look_up(key)});
  return static_cast<std::uint32_t>(memory_.met.size());
}

// Place in crossed, or kClear.
std::uint32_t ViewCaster::look_up(BlockKey key) {
  if (BlockDirectory::chunk_key(key) != chunk_key_) {
    chunk_key_ = BlockDirectory::chunk_key(key);
    chunk_ = map_.chunk(key);
  }
  Crossed block{nullptr, &kNothing, &kNothing, {}};
  if (chunk_ != nullptr) {
    const std::size_t place = BlockDirectory::place_in_chunk(key);
    const unsigned summary = chunk_->summaries[place];
    constexpr unsigned kRelevant = BlockSummary::kComplete | BlockSummary::kOccupied;
    if (!all_ && (summary & kRelevant) == BlockSummary::kComplete) return kClear;
    if (chunk_->slots[place] != BlockDirectory::kFree) {
      block.known = &map_.block_in_slot(chunk_->slots[place]);
      block.observed = &block.known->observed;
      fetch_early(*block.observed);
      if ((summary & BlockSummary::kOccupied) != 0) {
        block.occupied = &block.known->occupied;
        fetch_early(*block.occupied);
      }
    }
  }
  memory_.crossed.push_back(block);
  return static_cast<std::uint32_t>(memory_.crossed.size() - 1);
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
  if (memory_.enters.size() < most) {
    memory_.at.resize(most);
    memory_.offset.resize(most / 4 + 1);
    memory_.enters.resize(most);
    memory_.way.resize(most + 1);
  }
  walk_rays_(memory_.lanes, most,
             {memory_.at.front().items.data(), memory_.offset.front().items.data(),
              memory_.enters.data()});
  for (std::size_t lane = 0; lane < ends.size(); ++lane) {
    const std::size_t blocks = find_way(lane, rays[lane].voxels);
    follow(lane, blocks, rays[lane]);
  }
}

// All blocks a ray could come to, before it is followed: their memory is fetched meanwhile. Returns
// how many they are; one more says where the last one ends.
std::size_t ViewCaster::find_way(std::size_t lane, std::size_t voxels) {
  OnTheWay* const way = memory_.way.data();
  std::size_t blocks = 0;
  for (std::size_t step = 0; step < voxels; ++step) {  // no branch: it would be mispredicted
    way[blocks].step = static_cast<std::uint32_t>(step);
    blocks += memory_.enters[step] >> lane & 1;
  }
  way[blocks].step = static_cast<std::uint32_t>(voxels);
  for (std::size_t i = 0; i < blocks; ++i) {
    const PackedVoxel at = memory_.at[way[i].step].items[lane];
    const int x = packed_voxel::block_along(at, 0), y = packed_voxel::block_along(at, 1),
              z = packed_voxel::block_along(at, 2);
    way[i].cell = static_cast<std::uint32_t>((z * blocks_.y() + y) * blocks_.x() + x);
    std::uint32_t& number = memory_.number[way[i].cell];
    if (number == kNew) {
      number =
          number_new(pack_block(first_block_.x() + x, first_block_.y() + y, first_block_.z() + z));
    }
    way[i].crossed = memory_.met[number - 1].crossed;
  }
  return blocks;
}

void ViewCaster::follow(std::size_t lane, std::size_t blocks, Ray ray) {
  const std::uint16_t* offsets = memory_.offset.front().items.data() + lane;
  const OnTheWay* const way = memory_.way.data();
  for (std::size_t i = 0; i < blocks; ++i) {
    memory_.entered[way[i].cell >> 6] |= std::uint64_t{1} << (way[i].cell & 63);
    if (way[i].crossed == kClear) continue;
    if (!walk_in_block(memory_.crossed[way[i].crossed], offsets + way[i].step * RayLanes::kCount,
                       way[i + 1].step - way[i].step, ray.unknown_left)) {
      return;
    }
  }
}

// False: the ray ends here.
bool ViewCaster::walk_in_block(Crossed& block, const std::uint16_t* offsets, std::size_t voxels,
                               std::size_t& unknown_left) {
  const VoxelMask& observed = *block.observed;
  const VoxelMask& occupied = *block.occupied;
  std::size_t left = unknown_left;
  for (std::size_t i = 0; i < voxels; ++i) {
    const std::size_t offset = offsets[i * RayLanes::kCount];
    const std::size_t slice = offset >> 6;
    const std::uint64_t bit = std::uint64_t{1} << (offset & 63);
    if ((occupied.slices[slice] & bit) != 0) {
      if (all_) stop_at(block, slice, bit);
      return false;
    }
    block.voxels.slices[slice] |= bit;
    left -= (observed.slices[slice] & bit) == 0;
    if (left == 0) return false;
  }
  unknown_left = left;
  return true;
}

void ViewCaster::stop_at(const Crossed& block, std::size_t slice, std::uint64_t bit) {
  const auto i = static_cast<std::size_t>(&block - memory_.crossed.data());
  if (memory_.stops.size() <= i) memory_.stops.resize(memory_.crossed.size());
  memory_.stops[i].slices[slice] |= bit;
}

// Cell order is key order.
template <typename Visit>
void ViewCaster::for_each_entered(Visit&& visit) const {
  const std::uint32_t* number = memory_.number.data();
  for (const std::uint64_t word : memory_.entered) {
    for (std::uint64_t bits = word; bits != 0; bits &= bits - 1) {
      const Met& met = memory_.met[number[std::countr_zero(bits)] - 1];
      visit(met.key, met.crossed == kClear ? nullptr : &memory_.crossed[met.crossed]);
    }
    number += 64;
  }
}

ViewCast ViewCaster::result() const {
  ViewCast cast;
  std::size_t count = 0;
  for (const std::uint64_t word : memory_.entered) {
    count += static_cast<std::size_t>(std::popcount(word));
  }
  cast.touched.reserve(count);
  memory_.found.clear();
  for_each_entered([&](BlockKey key, const Crossed* block) {
    cast.touched.push_back(key);
    if (block == nullptr) return;
    VoxelMask voxels = block->voxels;
    voxels -= *block->observed;
    if (voxels.any()) memory_.found.push_back({key, voxels});
  });
  cast.unknown = VoxelSet::of_sorted({memory_.found.begin(), memory_.found.end()});
  return cast;
}

SeenVoxels ViewCaster::all() const {
  SeenVoxels seen;
  std::vector<VoxelSet::Block> unknown, free, occupied, roi;
  for_each_entered([&](BlockKey key, const Crossed* block) {
    seen.touched.push_back(key);
    VoxelMask not_known = block->voxels;
    if (block->known != nullptr) {
      not_known -= block->known->observed;
      VoxelMask known = block->voxels;
      known &= block->known->observed;
      free.push_back({key, known});
      const auto i = static_cast<std::size_t>(block - memory_.crossed.data());
      const VoxelMask stops = i < memory_.stops.size() ? memory_.stops[i] : VoxelMask{};
      occupied.push_back({key, stops});
      VoxelMask fruit = block->voxels;
      fruit |= stops;
      fruit &= block->known->roi;
      roi.push_back({key, fruit});
    }
    unknown.push_back({key, not_known});
  });
  seen.unknown = VoxelSet(std::move(unknown));
  seen.free = VoxelSet(std::move(free));
  seen.occupied = VoxelSet(std::move(occupied));
  seen.roi = VoxelSet(std::move(roi));
  return seen;
}

}  // namespace canopeer
