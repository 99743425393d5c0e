#include "canopeer/config/ros2_file.h"

#include <string>
#include <vector>

namespace canopeer {
namespace {

/// A mapping of names to names.
std::map<std::string, std::string> read_names(YamlMap names) {
  std::map<std::string, std::string> read;
  for (const std::string& name : names.keys()) read[name] = names.text(name, {});
  return read;
}

void read_ros2_arm(YamlMap arm, Ros2ArmSettings& o) {
  o.action = arm.text("action", o.action);
  o.joint_states = arm.text_or_texts("joint_states", o.joint_states);
  o.joint_names = read_names(arm.map("joint_names"));
  o.rate_hz = arm.number("rate_hz", o.rate_hz, {1.0, 1000.0});
  o.speed_scale = arm.number("speed_scale", o.speed_scale, {0.01, 1.0});
  o.first_motions = arm.integer("first_motions", o.first_motions, 0, 1000);
  o.first_motion_scale = arm.number("first_motion_scale", o.first_motion_scale, {0.01, 1.0});
  o.start_tolerance_rad = arm.number("start_tolerance_rad", o.start_tolerance_rad, {1e-4, 0.1});
  o.path_tolerance_rad = arm.number("path_tolerance_rad", o.path_tolerance_rad, {0.0, 3.0});
  o.goal_tolerance_rad = arm.number("goal_tolerance_rad", o.goal_tolerance_rad, {0.0, 1.0});
  o.goal_time_tolerance_s =
      arm.number("goal_time_tolerance_s", o.goal_time_tolerance_s, {0.0, 3600.0});
  o.max_silence_s = arm.number("max_silence_s", o.max_silence_s, {0.01, 60.0});
  o.max_slowdown = arm.number("max_slowdown", o.max_slowdown, {1.0, 1e6});
  o.safety_mode = arm.text("safety_mode", o.safety_mode);
}

void read_ros2_camera(YamlMap camera, Ros2CameraSettings& o) {
  o.color = camera.text("color", o.color);
  o.depth = camera.text("depth", o.depth);
  o.info = camera.text("info", o.info);
  o.points = camera.text("points", o.points);
  o.labels = camera.text("labels", o.labels);
  o.confidences = camera.text("confidences", o.confidences);
  o.min_confidence = camera.number("min_confidence", o.min_confidence, {0.0, 1.0});
  o.reliable = camera.boolean("reliable", o.reliable);
  o.max_difference_s = camera.number("max_difference_s", o.max_difference_s, {0.0, 1.0});
  o.pose = camera.choice("pose", o.pose, {"joint_states", "tf"});
  o.optical_frame = camera.text("optical_frame", o.optical_frame);
  o.world_frame = camera.text("world_frame", o.world_frame);
  o.time_offset_s = camera.number("time_offset_s", o.time_offset_s, {-10.0, 10.0});
  o.settle_s = camera.number("settle_s", o.settle_s, {0.0, 60.0});
  o.timeout_s = camera.number("timeout_s", o.timeout_s, {0.05, 3600.0});
}

Ros2TrolleySettings::Kind trolley_kind(const std::string& name) {
  using Kind = Ros2TrolleySettings::Kind;
  if (name == "fixed") return Kind::fixed;
  if (name == "trajectory") return Kind::trajectory;
  return name == "topics" ? Kind::topics : Kind::manual;
}

void read_ros2_trolley(YamlMap trolley, Ros2TrolleySettings& o) {
  o.kind =
      trolley_kind(trolley.choice("kind", "manual", {"fixed", "trajectory", "topics", "manual"}));
  o.start_m = trolley.numbers("start_m", o.start_m, 0, {-1000.0, 1000.0});
  o.action = trolley.text("action", o.action);
  o.travel_command = trolley.text("travel_command", o.travel_command);
  o.travel_state = trolley.text("travel_state", o.travel_state);
  o.lift_command = trolley.text("lift_command", o.lift_command);
  o.lift_state = trolley.text("lift_state", o.lift_state);
  o.speed_m_s = trolley.number("speed_m_s", o.speed_m_s, {0.001, 10.0});
  o.tolerance_m = trolley.number("tolerance_m", o.tolerance_m, {1e-5, 1.0});
  o.timeout_s = trolley.number("timeout_s", o.timeout_s, {0.1, 86400.0});
  o.manual_tolerance_m = trolley.number("manual_tolerance_m", o.manual_tolerance_m, {0.0, 2.0});
}

void read_ros2_output(YamlMap output, Ros2OutputSettings& o) {
  o.enabled = output.boolean("enabled", o.enabled);
  o.robot_description = output.boolean("robot_description", o.robot_description);
  o.tf = output.boolean("tf", o.tf);
  o.map_frame = output.text("map_frame", o.map_frame);
  o.map_rate_hz = output.number("map_rate_hz", o.map_rate_hz, {0.0, 100.0});
  o.image_rate_hz = output.number("image_rate_hz", o.image_rate_hz, {0.0, 100.0});
}

/// What no single key's range says: "ros2.SECTION.KEY: what is wrong".
void complain_where_it_is(YamlMap& ros2, const std::string& message) {
  const std::size_t section = message.find('.') + 1;
  const std::size_t end = message.find_first_of(".:", section);
  ros2.complain(message.substr(section, end - section), message.substr(end + 1));
}

Ros2Settings read_ros2_keys(YamlMap& ros2) {
  Ros2Settings o;
  o.node = ros2.text("node", o.node);
  o.ns = ros2.text("namespace", o.ns);
  if (const int domain = ros2.integer("domain", -1, -1, 232); domain >= 0) o.domain = domain;
  o.interfaces = ros2.text_or_texts("interfaces", o.interfaces);
  o.peers = ros2.text_or_texts("peers", o.peers);
  o.remaps = read_names(ros2.map("remaps"));
  o.shared_memory = ros2.boolean("shared_memory", o.shared_memory);
  o.use_sim_time = ros2.boolean("use_sim_time", o.use_sim_time);
  o.discovery_s = ros2.number("discovery_s", o.discovery_s, {0.1, 3600.0});
  read_ros2_arm(ros2.map("arm"), o.arm);
  read_ros2_camera(ros2.map("camera"), o.camera);
  read_ros2_trolley(ros2.map("trolley"), o.trolley);
  read_ros2_output(ros2.map("output"), o.output);
  o.dry_run = ros2.boolean("dry_run", o.dry_run);
  o.confirm = ros2.boolean("confirm", o.confirm);
  o.wait_for_start = ros2.boolean("wait_for_start", o.wait_for_start);
  if (auto ok = o.validate(); !ok) complain_where_it_is(ros2, ok.error().message);
  return o;
}

}  // namespace

Expected<std::optional<YamlMap>> open_ros2_file(YamlMap& mission) {
  if (!mission.is_text("ros2")) return std::nullopt;
  const auto path = mission.directory() / mission.text("ros2", {});
  auto file = YamlMap::load(path, "ros2");
  if (!file) return fail_in(mission.where("ros2") + ": ros2", file.error());
  return std::move(*file);
}

std::optional<Ros2Settings> read_ros2(YamlMap& mission, std::optional<YamlMap>& file) {
  if (file) return read_ros2_keys(*file);
  const bool there = mission.has("ros2");
  YamlMap ros2 = mission.map("ros2");  // also where it is not: a key that one may ask for
  if (!there) return std::nullopt;
  return read_ros2_keys(ros2);
}

}  // namespace canopeer
