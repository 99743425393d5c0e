#pragma once

#include <cstdint>
#include <string_view>

// Humble and Jazzy have the same layout.

namespace canopeer::ros::builtin_interfaces {

/// Since 1970, or since a simulation began.
struct Time {
  static constexpr std::string_view kType = "builtin_interfaces/msg/Time";
  std::int32_t sec{};
  std::uint32_t nanosec{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(sec, nanosec);
  }
};

struct Duration {
  static constexpr std::string_view kType = "builtin_interfaces/msg/Duration";
  std::int32_t sec{};
  std::uint32_t nanosec{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(sec, nanosec);
  }
};

}  // namespace canopeer::ros::builtin_interfaces
