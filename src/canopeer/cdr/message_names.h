#pragma once

#include <string>
#include <string_view>

// Names of types on the wire. A message has `static constexpr std::string_view kType`, as ROS
// writes it: "sensor_msgs/msg/JointState", "std_srvs/srv/Trigger",
// "control_msgs/action/FollowJointTrajectory".

namespace canopeer::ros {

/// "sensor_msgs/msg/JointState" → "sensor_msgs::msg::dds_::JointState" + suffix.
[[nodiscard]] std::string dds_type_name(std::string_view ros_type, std::string_view suffix = "_");

/// The way back: "sensor_msgs::msg::dds_::JointState_" → "sensor_msgs/msg/JointState". What is no
/// such name stays as it is.
[[nodiscard]] std::string ros_type_name(std::string_view dds_type);

template <class Message>
[[nodiscard]] std::string dds_type() {
  return dds_type_name(Message::kType);
}
template <class Service>
[[nodiscard]] std::string dds_request_type() {
  return dds_type_name(Service::kType, "_Request_");
}
template <class Service>
[[nodiscard]] std::string dds_response_type() {
  return dds_type_name(Service::kType, "_Response_");
}

}  // namespace canopeer::ros
