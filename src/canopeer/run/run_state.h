#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "canopeer/mission/mission_state.h"

namespace canopeer {

/// A run between two steps, as a value: its mission, where everything behind the ports is, how long
/// its record was, and the frames that are compared in the end.
struct RunState {
  std::string run;  ///< which one: mission, planner, seed, version, settings
  MissionState mission;
  std::string site;  ///< as Site::save() gives it
  std::uint64_t record_bytes = 0;
  std::string frame_check;  ///< as FrameCheck::save() gives it; empty: there is none
};

/// Compressed and checksummed; the whole file or none. The same state, the same bytes.
[[nodiscard]] Expected<void> write_run_state(const std::filesystem::path& path,
                                             const RunState& state);

/// `options`: of the mission that goes on. The error names the file and says what is wrong: no
/// state, another version, damaged.
[[nodiscard]] Expected<RunState> read_run_state(const std::filesystem::path& path,
                                                const MissionOptions& options);

}  // namespace canopeer
