#include "canopeer/run/run_state.h"

#include <zlib.h>
#include <zstd.h>

#include <string_view>
#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

constexpr std::string_view kMagic = "CANOPEER-STATE 1\n";
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 32;  // 4 GiB: more is damage
constexpr int kLevel = 1;  // a state is written often and read seldom

std::uint64_t checksum(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

Expected<std::string> unpacked(std::string_view file) {
  if (file.substr(0, kMagic.size()) != kMagic) {
    return fail(file.starts_with("CANOPEER-STATE ") ? "a run state of another version of canopeer"
                                                    : "this is no run state");
  }
  file.remove_prefix(kMagic.size());
  std::uint64_t size = 0;
  std::uint64_t sum = 0;
  std::string packed;
  if (auto ok = read_state_bytes(file, size, sum, packed); !ok) return tl::unexpected(ok.error());
  if (checksum(packed) != sum || size > kMostBytes ||
      ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) {
    return fail("damaged");
  }
  std::string bytes(size, '\0');
  const std::size_t got = ZSTD_decompress(bytes.data(), size, packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) return fail("damaged");
  return bytes;
}

}  // namespace

Expected<void> write_run_state(const std::filesystem::path& path, const RunState& state) {
  const std::string bytes = state_bytes(state.run, mission_state_bytes(state.mission), state.site,
                                        state.record_bytes, state.frame_check);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) {
    return fail(path.string() + ": cannot be compressed: " + ZSTD_getErrorName(size));
  }
  packed.resize(size);
  const auto raw_size = static_cast<std::uint64_t>(bytes.size());
  return write_file(path, std::string(kMagic) + state_bytes(raw_size, checksum(packed), packed));
}

Expected<RunState> read_run_state(const std::filesystem::path& path,
                                  const MissionOptions& options) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected(file.error());
  const auto bytes = unpacked(*file);
  if (!bytes) return fail_in(path.string(), bytes.error());
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
