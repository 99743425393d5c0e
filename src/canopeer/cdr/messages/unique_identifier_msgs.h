#pragma once

#include <array>
#include <cstdint>
#include <string_view>

// Humble and Jazzy have the same layout.

namespace canopeer::ros::unique_identifier_msgs {

struct UUID {
  static constexpr std::string_view kType = "unique_identifier_msgs/msg/UUID";
  std::array<std::uint8_t, 16> uuid{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(uuid);
  }
  bool operator==(const UUID&) const = default;
};

}  // namespace canopeer::ros::unique_identifier_msgs
