#include "canopeer/run/run_state.h"

#include <utility>

#include "canopeer/geometry/packed_file.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

constexpr PackedKind kStateKind{"CANOPEER-STATE 1\n", "run state"};

}  // namespace

Expected<void> write_run_state(const std::filesystem::path& path, const RunState& state) {
  const std::string bytes = state_bytes(state.run, mission_state_bytes(state.mission), state.site,
                                        state.record_bytes, state.frame_check);
  return write_packed(path, kStateKind, bytes);
}

Expected<RunState> read_run_state(const std::filesystem::path& path,
                                  const MissionOptions& options) {
  const auto bytes = read_packed(path, kStateKind);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string run;
  std::string mission_bytes;
  std::string site;
  std::uint64_t record_bytes = 0;
  std::string frame_check;
  if (auto ok = read_state_bytes(*bytes, run, mission_bytes, site, record_bytes, frame_check);
      !ok) {
    return fail_in(path.string(), ok.error());
  }
  auto mission = parse_mission_state(mission_bytes, options);
  if (!mission) return fail_in(path.string(), mission.error());
  return RunState{std::move(run), std::move(*mission), std::move(site), record_bytes,
                  std::move(frame_check)};
}

}  // namespace canopeer
