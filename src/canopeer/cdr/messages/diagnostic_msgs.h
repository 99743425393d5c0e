#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::diagnostic_msgs {

struct KeyValue {
  static constexpr std::string_view kType = "diagnostic_msgs/msg/KeyValue";
  std::string key;
  std::string value;
  template <class Archive>
  void visit(Archive& archive) {
    archive(key, value);
  }
};

struct DiagnosticStatus {
  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr std::uint8_t OK = 0;
  static constexpr std::uint8_t WARN = 1;
  static constexpr std::uint8_t ERROR = 2;
  static constexpr std::uint8_t STALE = 3;
  std::uint8_t level{};
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;
  template <class Archive>
  void visit(Archive& archive) {
    archive(level, name, message, hardware_id, values);
  }
};

struct DiagnosticArray {
  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticArray";
  std_msgs::Header header;
  std::vector<DiagnosticStatus> status;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, status);
  }
};

}  // namespace canopeer::ros::diagnostic_msgs
