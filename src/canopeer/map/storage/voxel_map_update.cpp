#include <tbb/parallel_for.h>

#include "canopeer/map/storage/block_key_order.h"
#include "canopeer/map/storage/kept.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {
namespace {

// Blocks looked at, and blocks whose log-odds are stepped, between a prefetch and its use.
constexpr std::size_t kAhead = 8;
constexpr std::size_t kAheadCells = 2;

// Finds the chunks of blocks that come chunk by chunk.
class Chunks {
 public:
  explicit Chunks(BlockDirectory& directory) : directory_(directory) {}
  BlockDirectory::Chunk& of(BlockKey key) {
    if (BlockDirectory::chunk_key(key) != key_) {
      key_ = BlockDirectory::chunk_key(key);
      chunk_ = &directory_.chunk_to_write(key);
    }
    return *chunk_;
  }

 private:
  BlockDirectory& directory_;
  BlockDirectory::Chunk* chunk_ = nullptr;
  BlockKey key_ = ~BlockKey{0};
};

// Brings memory that is soon read and written near.
template <typename T>
void prefetch(const T& item) {
  const auto* bytes = reinterpret_cast<const char*>(&item);
  for (std::size_t i = 0; i < sizeof(T); i += 64) __builtin_prefetch(bytes + i, 1);
}

}  // namespace

// What is done in a few words is done at once; the rest, with its storage in place, in parallel.
UpdateResult VoxelMap::apply(std::span<const BlockUpdate> updates,
                             std::span<const BlockKey> all_free, std::span<const FreeBlock> free,
                             SimdLevel simd) {
  ++updates_;
  UpdateResult result;
  Chunks chunks(directory_);
  // Slots are found or made well before they are looked at.
  Kept<std::vector<Place>> kept_places;
  std::vector<Place>& places = *kept_places;
  places.clear();
  const auto find = [&](BlockKey key) {
    BlockDirectory::Chunk& chunk = chunks.of(key);
    const std::size_t in_chunk = BlockDirectory::place_in_chunk(key);
    Place& place = places.emplace_back();
    place.slot = slot_for(chunk, in_chunk, key);
    place.summary = &chunk.summaries[in_chunk];
  };
  for (const BlockUpdate& update : updates) find(update.key);
  for (const FreeBlock& block : free) find(block.key);
  for (const BlockKey key : all_free) find(key);
  std::size_t next = 0, left = 0;
  const auto place_of_next = [&] {
    if (next + kAhead < places.size()) {
      prefetch(blocks_[places[next + kAhead].slot]);
      prefetch(masks_[places[next + kAhead].slot]);
    }
    return places[next++];
  };
  for (const BlockUpdate& update : updates) {
    Place place = place_of_next();
    const bool misses = !update.hit.any() && !update.roi_hit.any() && !update.roi_miss.any();
    if (misses && apply_alike(update.miss, place, result)) continue;
    take_storage(update, place);
    place.update = &update;
    places[left++] = place;
  }
  for (const FreeBlock& block : free) {
    Place place = place_of_next();
    if (apply_alike(block.free, place, result)) continue;
    own_log_odds(blocks_.own(place.slot), masks_.own(place.slot).observed);
    place.miss = &block.free;
    places[left++] = place;
  }
  for (std::size_t i = 0; i < all_free.size(); ++i) {
    const Place place = place_of_next();
    if (apply_uniform(place, result)) continue;
    own_log_odds(blocks_.own(place.slot), masks_.own(place.slot).observed);
    places[left++] = place;
  }
  const LogOddsKernels& kernels = log_odds_kernels(simd);
  places.resize(left);
  Kept<std::vector<Outcome>> kept_outcomes;
  std::vector<Outcome>& outcomes = *kept_outcomes;
  outcomes.resize(left);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, outcomes.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          if (i + 2 * kAheadCells < places.size()) {
            prefetch(blocks_[places[i + 2 * kAheadCells].slot]);
            prefetch(masks_[places[i + 2 * kAheadCells].slot]);
          }
          if (i + kAheadCells < places.size()) {
            prefetch(log_odds_[blocks_[places[i + kAheadCells].slot].log_odds]);
          }
          const Place& place = places[i];
          outcomes[i] = place.update != nullptr ? apply(*place.update, place, kernels)
                        : place.miss != nullptr ? apply_misses(*place.miss, place, kernels)
                                                : apply_all_free(place, kernels);
        }
      });
  for (std::size_t i = 0; i < outcomes.size(); ++i) count(outcomes[i], places[i].slot, result);
  observed_voxels_ += result.newly_known;
  sort_keys(result.changed);
  return result;
}

}  // namespace canopeer
