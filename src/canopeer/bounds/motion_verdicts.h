#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>

namespace canopeer {

/// Which straight motions between views of one pool are free: what the exact judge said, for the
/// next plan. Not thread-safe.
class MotionVerdicts {
 public:
  /// Indices into the pool's segments and their views; none: nobody asked yet.
  [[nodiscard]] std::optional<bool> known(std::size_t segment, std::size_t from,
                                          std::size_t to) const {
    const auto found = free_.find(key(segment, from, to));
    return found == free_.end() ? std::nullopt : std::optional(found->second);
  }
  void keep(std::size_t segment, std::size_t from, std::size_t to, bool free) {
    free_.emplace(key(segment, from, to), free);
  }

 private:
  /// Pools have fewer than 2^24 views a segment.
  static std::uint64_t key(std::size_t segment, std::size_t from, std::size_t to) {
    return (std::uint64_t{segment} << 48) | (std::uint64_t{from} << 24) | std::uint64_t{to};
  }

  std::unordered_map<std::uint64_t, bool> free_;
};

}  // namespace canopeer
