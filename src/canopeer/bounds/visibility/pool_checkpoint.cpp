#include "canopeer/bounds/visibility/pool_checkpoint.h"

#include <optional>
#include <utility>

#include "canopeer/geometry/packed_file.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

constexpr PackedKind kCheckpointKind{"CANOPEER-VIEWS-PART 2\n", "part of a pool of views"};

/// None, an old one or a damaged one is no checkpoint: sampling begins anew.
std::optional<PoolState> read_checkpoint(const std::filesystem::path& path, const std::string& key,
                                         const FruitPatches& patches) {
  if (path.empty() || !std::filesystem::exists(path)) return std::nullopt;
  const auto bytes = read_packed(path, kCheckpointKind);
  if (!bytes) return std::nullopt;
  PoolState state;
  if (!read_state_bytes(*bytes, state)) return std::nullopt;
  const bool same = state.pool.key == key && state.pool.patches.fruit == patches.fruit &&
                    state.pool.times_seen.size() == patches.fruit.size() &&
                    state.times_seen.size() == patches.fruit.size();
  if (!same) return std::nullopt;
  return state;
}

}  // namespace

PoolState checkpoint_or_start(const std::filesystem::path& path, const std::string& key,
                              const FruitPatches& patches) {
  if (auto state = read_checkpoint(path, key, patches)) return std::move(*state);
  PoolState fresh;
  fresh.pool.patches = patches;
  fresh.pool.key = key;
  fresh.pool.times_seen.assign(patches.fruit.size(), 0);
  fresh.times_seen.assign(patches.fruit.size(), 0);
  return fresh;
}

Expected<void> write_checkpoint(const std::filesystem::path& path, const PoolState& state) {
  return write_packed(path, kCheckpointKind, state_bytes(state));
}

}  // namespace canopeer
