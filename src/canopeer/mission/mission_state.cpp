#include "canopeer/mission/mission_state.h"

#include <utility>

#include "canopeer/geometry/state_archive.h"
#include "canopeer/map/cmap_file.h"

namespace canopeer {

std::string mission_state_bytes(const MissionState& state) {
  return state_bytes(state.cursor, state.meters, state.traveller, cmap_bytes(state.map),
                     state.unsettled, state.fruits.state(), state.planner);
}

Expected<MissionState> parse_mission_state(std::string_view bytes, const MissionOptions& options) {
  MissionState state{MissionCursor(),         {}, {}, VoxelMap(options.map), {},
                     FruitMap(options.fruit), {}};
  std::string map;
  std::string fruits;
  auto read = read_state_bytes(bytes, state.cursor, state.meters, state.traveller, map,
                               state.unsettled, fruits, state.planner);
  if (!read) return tl::unexpected(read.error());
  if (state.cursor.next > MissionCursor::Step::done ||
      state.cursor.said > SteeringWord::Kind::stop || state.cursor.views < 0) {
    return fail("not a state of this version: it is nowhere in a mission");
  }
  auto voxels = parse_cmap(map);
  if (!voxels) return fail_in("map", voxels.error());
  state.map = std::move(*voxels);
  if (auto ok = state.fruits.restore(fruits); !ok) return tl::unexpected(ok.error());
  return state;
}

}  // namespace canopeer
