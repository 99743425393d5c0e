#include <bit>
#include <utility>

#include "canopeer/map/views/view_caster.h"

namespace canopeer {

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
  if (memory_.found_keys.size() <= met_) {
    memory_.found_keys.resize(2 * met_ + 1);
    memory_.found_places.resize(kBlockSide * memory_.found_keys.size());
    memory_.found_words.resize(kBlockSide * memory_.found_keys.size());
  }
  const SliceRoom found{memory_.found_keys.data(), memory_.found_places.data(),
                        memory_.found_words.data()};
  const SliceCount count = collect_unknown_(numbers, memory_.met.data(), first_key_, found);
  return {
      VoxelSet({found.keys, count.blocks}, {found.places, count.words}, {found.words, count.words}),
      BlockSet(first_block_, blocks_, memory_.entered)};
}

SeenVoxels ViewCaster::all() const {
  SeenVoxels seen;
  std::vector<VoxelSet::Block> unknown, free, occupied, roi;
  for (const std::uint32_t number : entered()) {
    const BlockKey key = first_key_ + memory_.met[number].place;
    const VoxelMask& crossed = memory_.met[number].crossed;
    VoxelMask not_known = crossed;
    if (const BlockMasks* masks = memory_.met[number].known; masks != nullptr) {
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
  seen.touched = BlockSet(first_block_, blocks_, memory_.entered);
  seen.unknown = VoxelSet(std::move(unknown));
  seen.free = VoxelSet(std::move(free));
  seen.occupied = VoxelSet(std::move(occupied));
  seen.roi = VoxelSet(std::move(roi));
  return seen;
}

}  // namespace canopeer
