#include "canopeer/fruit/updates/fruit_map_state.h"

#include <algorithm>

#include "canopeer/geometry/state_archive.h"

namespace canopeer {

std::string FruitMap::state() const { return state_bytes(state_->options.tsdf, *state_); }

Expected<void> FruitMap::restore(std::string_view state) {
  TsdfOptions tsdf;
  auto read = std::make_unique<State>(state_->options);
  if (auto ok = read_state_bytes(state, tsdf, *read); !ok) return fail_in("fruit map", ok.error());
  if (tsdf != state_->options.tsdf) {
    return fail("fruit map: the state was made with other options of signed distances (tsdf)");
  }
  if (!read->rebuild()) {
    return fail("fruit map: not a state of this version: its parts do not fit together");
  }
  state_ = std::move(read);
  return {};
}

/// What is counted and copied from the rest, as it was when it was written: points that count are
/// counted whenever a block's surface is made anew, and fruits are handed out as they are known.
/// False: numbers of blocks that there are not, or surface that is not where it says.
bool FruitMap::State::rebuild() {
  if (!surface.relink()) return false;
  const std::size_t blocks = surface.tsdf().blocks().size();
  if (waits_since.size() > blocks) return false;
  for (const KnownFruit& fruit : known) {
    const auto exists = [&](int n) { return n >= 0 && static_cast<std::size_t>(n) < blocks; };
    if (!std::all_of(fruit.blocks.begin(), fruit.blocks.end(), exists)) return false;
  }
  fruit_points.assign(blocks, 0);
  for (std::size_t block = 0; block < blocks; ++block) count_points(static_cast<int>(block));
  hand_out();
  return true;
}

}  // namespace canopeer
