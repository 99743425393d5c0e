#include "canopeer/replay/replay_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "canopeer/base/byte_order.h"

namespace canopeer {
namespace {

constexpr std::string_view kReplayMagic = "CANOPEER-REPLAY 1\n";
constexpr std::size_t kPieceHead = 16;  // packed size, unpacked size, frames, checksum
constexpr std::uint32_t kMostUnpacked = 1U << 28;
constexpr int kReplayLevel = 6;

/// Where a piece lies.
struct Piece {
  std::uint64_t at = 0;  // of its packed octets
  std::uint32_t packed = 0;
  std::uint32_t unpacked = 0;
  std::uint32_t frames = 0;
  std::uint32_t checksum = 0;
};

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

bool read_at(int file, std::uint64_t at, char* to, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::pread(file, to, size, static_cast<off_t>(at));
    if (got <= 0) return false;
    to += got;
    at += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool write_at(int file, std::uint64_t at, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (put <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(put));
    at += static_cast<std::uint64_t>(put);
  }
  return true;
}

/// Each frame with its length in front.
std::string joined(const std::vector<Frame>& frames) {
  std::string all;
  for (const Frame& frame : frames) {
    const std::string bytes = frame.bytes();
    append_number(all, static_cast<std::uint32_t>(bytes.size()));
    all += bytes;
  }
  return all;
}

Expected<std::vector<std::string>> split(std::string_view all) {
  std::vector<std::string> frames;
  while (!all.empty()) {
    if (all.size() < 4) return fail("a replay's piece is damaged");
    const auto size = load_number<std::uint32_t>(all.data());
    if (size > all.size() - 4) return fail("a replay's piece is damaged");
    frames.emplace_back(all.substr(4, size));
    all.remove_prefix(4 + size);
  }
  return frames;
}

std::string system_error(const std::string& what) { return what + ": " + std::strerror(errno); }

}  // namespace

struct ReplayLog::State {
  int file = -1;
  std::string name;
  std::uint64_t end = 0;  // of the last whole piece
  std::uint64_t lost = 0;
  mutable std::mutex mutex;  // of what follows
  std::vector<Piece> pieces;
  std::size_t frames = 0;
  std::mutex listener_mutex;
  std::function<void()> listener;

  State(int f, std::string n) : file(f), name(std::move(n)) {}
  ~State() { ::close(file); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  Expected<void> begin() {
    if (!write_at(file, 0, kReplayMagic)) return fail(system_error(name));
    end = kReplayMagic.size();
    return {};
  }
  [[nodiscard]] std::optional<Piece> piece_head(std::uint64_t at, std::uint64_t size) const {
    char head[kPieceHead];
    if (at + kPieceHead > size || !read_at(file, at, head, kPieceHead)) return std::nullopt;
    Piece piece{at + kPieceHead, load_number<std::uint32_t>(head),
                load_number<std::uint32_t>(head + 4), load_number<std::uint32_t>(head + 8),
                load_number<std::uint32_t>(head + 12)};
    const bool empty = piece.packed == 0 || piece.unpacked == 0 || piece.frames == 0;
    if (empty || piece.packed > size - piece.at || piece.unpacked > kMostUnpacked) {
      return std::nullopt;
    }
    return piece;
  }
  [[nodiscard]] Expected<std::string> unpacked(const Piece& piece) const {
    std::string packed(piece.packed, '\0');
    if (!read_at(file, piece.at, packed.data(), packed.size()) ||
        crc_of(packed) != piece.checksum) {
      return fail(name + ": a piece of the replay is damaged");
    }
    std::string all(piece.unpacked, '\0');
    const std::size_t got = ZSTD_decompress(all.data(), all.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) != 0 || got != all.size()) {
      return fail(name + ": a piece of the replay is damaged");
    }
    return all;
  }
  /// All whole pieces up to the first that is none: what comes later builds on it.
  Expected<void> index() {
    struct stat info {};
    if (::fstat(file, &info) != 0) return fail(system_error(name));
    const auto size = static_cast<std::uint64_t>(info.st_size);
    std::string magic(kReplayMagic.size(), '\0');
    if (!S_ISREG(info.st_mode) || !read_at(file, 0, magic.data(), magic.size()) ||
        magic != kReplayMagic) {
      return fail(name + ": not a replay of this version of canopeer");
    }
    end = kReplayMagic.size();
    while (const auto piece = piece_head(end, size)) {
      const auto all = unpacked(*piece);
      const Expected<std::vector<std::string>> split_up =
          all ? split(*all) : Expected<std::vector<std::string>>(tl::unexpected(all.error()));
      if (!split_up || split_up->size() != piece->frames) break;
      pieces.push_back(*piece);
      frames += piece->frames;
      end = piece->at + piece->packed;
    }
    lost = size - end;
    return {};
  }
};

ReplayLog::ReplayLog(std::unique_ptr<State> state) : state_(std::move(state)) {}
ReplayLog::~ReplayLog() = default;

Expected<std::unique_ptr<ReplayLog>> ReplayLog::create(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return fail(system_error(path.string()));
  auto state = std::make_unique<State>(file, path.string());
  if (auto ok = state->begin(); !ok) return tl::unexpected(ok.error());
  return std::unique_ptr<ReplayLog>(new ReplayLog(std::move(state)));
}

Expected<std::unique_ptr<ReplayLog>> ReplayLog::create_unnamed() {
  std::string name = (std::filesystem::temp_directory_path() / "canopeer-replay-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) return fail(system_error(name));
  ::unlink(name.c_str());
  auto state = std::make_unique<State>(file, name);
  if (auto ok = state->begin(); !ok) return tl::unexpected(ok.error());
  return std::unique_ptr<ReplayLog>(new ReplayLog(std::move(state)));
}

Expected<std::unique_ptr<ReplayLog>> ReplayLog::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(system_error(path.string()));
  auto state = std::make_unique<State>(file, path.string());
  if (auto ok = state->index(); !ok) return tl::unexpected(ok.error());
  return std::unique_ptr<ReplayLog>(new ReplayLog(std::move(state)));
}

Expected<void> ReplayLog::append(const std::vector<Frame>& frames) {
  if (frames.empty()) return {};
  State& s = *state_;
  const std::string all = joined(frames);
  if (all.size() > kMostUnpacked) return fail(s.name + ": a piece of more than 256 MB");
  std::string packed(ZSTD_compressBound(all.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), all.data(), all.size(), kReplayLevel);
  if (ZSTD_isError(size) != 0) return fail(s.name + ": " + ZSTD_getErrorName(size));
  packed.resize(size);
  const Piece piece{s.end + kPieceHead, static_cast<std::uint32_t>(size),
                    static_cast<std::uint32_t>(all.size()),
                    static_cast<std::uint32_t>(frames.size()), crc_of(packed)};
  std::string bytes;
  for (const std::uint32_t number : {piece.packed, piece.unpacked, piece.frames, piece.checksum})
    append_number(bytes, number);
  if (!write_at(s.file, s.end, bytes + packed)) return fail(system_error(s.name));
  s.end = piece.at + piece.packed;
  {
    const std::scoped_lock lock(s.mutex);
    s.pieces.push_back(piece);
    s.frames += frames.size();
  }
  const std::scoped_lock lock(s.listener_mutex);
  if (s.listener) s.listener();
  return {};
}

std::size_t ReplayLog::pieces() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->pieces.size();
}

std::size_t ReplayLog::frames() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->frames;
}

Expected<std::vector<std::string>> ReplayLog::piece(std::size_t index) const {
  Piece piece;
  {
    const std::scoped_lock lock(state_->mutex);
    if (index >= state_->pieces.size()) return fail("the replay has no such piece");
    piece = state_->pieces[index];
  }
  const auto all = state_->unpacked(piece);
  if (!all) return tl::unexpected(all.error());
  return split(*all);
}

std::uint64_t ReplayLog::lost_bytes() const { return state_->lost; }

void ReplayLog::on_append(std::function<void()> listener) {
  const std::scoped_lock lock(state_->listener_mutex);
  state_->listener = std::move(listener);
}

}  // namespace canopeer
