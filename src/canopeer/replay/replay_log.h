#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/replay/frame.h"

namespace canopeer {

/// The frames of a run in a file, in pieces (docs/formats.md). One thread writes, others read what
/// is there already. A file that was cut off is read up to its last whole piece. It takes the
/// memory of an index only.
class ReplayLog {
 public:
  /// Empty, in place of what was there. The error names the file.
  [[nodiscard]] static Expected<std::unique_ptr<ReplayLog>> create(
      const std::filesystem::path& path);
  /// One that leaves nothing behind.
  [[nodiscard]] static Expected<std::unique_ptr<ReplayLog>> create_unnamed();
  /// To read only. The error: no such file, or not one of a replay.
  [[nodiscard]] static Expected<std::unique_ptr<ReplayLog>> open(const std::filesystem::path& path);
  ~ReplayLog();

  /// One piece more, kept from now on. The error: the disk is full, say; what is there stays.
  [[nodiscard]] Expected<void> append(const std::vector<Frame>& frames);

  [[nodiscard]] std::size_t pieces() const;
  [[nodiscard]] std::size_t frames() const;
  /// The frames of a piece as they go over the wire. The error: the file was changed meanwhile.
  [[nodiscard]] Expected<std::vector<std::string>> piece(std::size_t index) const;
  /// Where open() found damage or a cut: octets behind that were left out.
  [[nodiscard]] std::uint64_t lost_bytes() const;

  /// Called after each append, in the thread that appends, and not any more once this has returned;
  /// empty: nobody. It must not append.
  void on_append(std::function<void()> listener);

 private:
  struct State;
  explicit ReplayLog(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
