#include "canopeer/ros2/arm/safety_mode.h"

#include "canopeer/cdr/messages/ur_dashboard_msgs.h"

namespace canopeer::ros {

using Mode = ur_dashboard_msgs::SafetyMode;

Expected<std::unique_ptr<SafetyMode>> SafetyMode::make(Node& node, const std::string& topic) {
  auto safety = std::make_unique<SafetyMode>();
  auto subscription = node.subscribe<Mode>(
      topic, kLatchedQos,
      [raw = safety.get()](const Mode& message, const Guid&) { raw->take(message.mode); });
  if (!subscription) return fail_in(topic, subscription.error());
  safety->subscription_ = std::move(*subscription);
  return safety;
}

std::optional<std::string> SafetyMode::stop() const {
  switch (const std::uint8_t mode = mode_) {
    case 0:  // not said yet
    case Mode::NORMAL:
    case Mode::REDUCED:
      return std::nullopt;
    case Mode::PROTECTIVE_STOP:
      return "protective stop";
    case Mode::RECOVERY:
      return "recovery: a joint is beyond its safety limits";
    case Mode::SAFEGUARD_STOP:
    case Mode::AUTOMATIC_MODE_SAFEGUARD_STOP:
      return "safeguard stop";
    case Mode::SYSTEM_EMERGENCY_STOP:
    case Mode::ROBOT_EMERGENCY_STOP:
      return "emergency stop";
    case Mode::VIOLATION:
      return "violation of a safety limit";
    case Mode::FAULT:
      return "fault of the robot";
    case Mode::SYSTEM_THREE_POSITION_ENABLING_STOP:
      return "the enabling switch is not pressed";
    default:
      return "safety mode " + std::to_string(mode);
  }
}

}  // namespace canopeer::ros
