#pragma once

#include <cstdint>
#include <string_view>

// ur_dashboard_msgs, as far as we use it.

namespace canopeer::ros::ur_dashboard_msgs {

struct SafetyMode {
  static constexpr std::string_view kType = "ur_dashboard_msgs/msg/SafetyMode";
  static constexpr std::uint8_t NORMAL = 1;
  static constexpr std::uint8_t REDUCED = 2;
  static constexpr std::uint8_t PROTECTIVE_STOP = 3;
  static constexpr std::uint8_t RECOVERY = 4;
  static constexpr std::uint8_t SAFEGUARD_STOP = 5;
  static constexpr std::uint8_t SYSTEM_EMERGENCY_STOP = 6;
  static constexpr std::uint8_t ROBOT_EMERGENCY_STOP = 7;
  static constexpr std::uint8_t VIOLATION = 8;
  static constexpr std::uint8_t FAULT = 9;
  static constexpr std::uint8_t VALIDATE_JOINT_ID = 10;
  static constexpr std::uint8_t UNDEFINED_SAFETY_MODE = 11;
  static constexpr std::uint8_t AUTOMATIC_MODE_SAFEGUARD_STOP = 12;
  static constexpr std::uint8_t SYSTEM_THREE_POSITION_ENABLING_STOP = 13;
  std::uint8_t mode{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(mode);
  }
};

}  // namespace canopeer::ros::ur_dashboard_msgs
