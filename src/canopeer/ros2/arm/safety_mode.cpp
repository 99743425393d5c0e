#include "canopeer/ros2/arm/safety_mode.h"

#include "canopeer/cdr/messages/ur_dashboard_msgs.h"

namespace canopeer::ros {
namespace {

using UrSafetyMode = ur_dashboard_msgs::SafetyMode;

}  // namespace

Expected<std::unique_ptr<SafetyMode>> SafetyMode::make(Node& node, const std::string& topic) {
  auto safety = std::make_unique<SafetyMode>();
  auto subscription = node.subscribe<UrSafetyMode>(
      topic, kLatchedQos,
      [raw = safety.get()](const UrSafetyMode& message, const Guid&) { raw->take(message.mode); });
  if (!subscription) return fail_in(topic, subscription.error());
  safety->subscription_ = std::move(*subscription);
  return safety;
}

std::optional<std::string> SafetyMode::stop() const {
  switch (const std::uint8_t mode = mode_) {
    case 0:  // not said yet
    case UrSafetyMode::NORMAL:
    case UrSafetyMode::REDUCED:
      return std::nullopt;
    case UrSafetyMode::PROTECTIVE_STOP:
      return "protective stop";
    case UrSafetyMode::RECOVERY:
      return "recovery: a joint is beyond its safety limits";
    case UrSafetyMode::SAFEGUARD_STOP:
    case UrSafetyMode::AUTOMATIC_MODE_SAFEGUARD_STOP:
      return "safeguard stop";
    case UrSafetyMode::SYSTEM_EMERGENCY_STOP:
    case UrSafetyMode::ROBOT_EMERGENCY_STOP:
      return "emergency stop";
    case UrSafetyMode::VIOLATION:
      return "violation of a safety limit";
    case UrSafetyMode::FAULT:
      return "fault of the robot";
    case UrSafetyMode::SYSTEM_THREE_POSITION_ENABLING_STOP:
      return "the enabling switch is not pressed";
    default:
      return "safety mode " + std::to_string(mode);
  }
}

}  // namespace canopeer::ros
