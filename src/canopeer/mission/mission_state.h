#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "canopeer/fruit/fruit_map.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/mission/mission_cursor.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/mission/segment/timekeeper.h"
#include "canopeer/mission/segment/traveller.h"

namespace canopeer {

/// A mission between two steps, as a value: all that later steps depend on beside the mission's
/// options and what stands behind its ports. A copy shares the voxel map's pages until one changes.
/// Two missions that go on from it, here or in another process, do the same.
struct MissionState {
  MissionCursor cursor;
  Timekeeper::Meters meters;
  Traveller::State traveller;
  VoxelMap map;
  std::vector<BlockKey> unsettled;  ///< blocks of the map that nobody was told of yet
  FruitMap fruits;
  std::optional<std::string> planner;  ///< as Planner::state() gives it; none before a segment
};

/// The state as bytes: the same state, the same bytes. They hold no checksum of their own.
[[nodiscard]] std::string mission_state_bytes(const MissionState& state);

/// Reads them back; `options` as in the mission that wrote them. The error says what is wrong.
[[nodiscard]] Expected<MissionState> parse_mission_state(std::string_view bytes,
                                                         const MissionOptions& options);

}  // namespace canopeer
