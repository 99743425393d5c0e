#include "ros2_words.h"

#include <cstdlib>

#include "canopeer/config/yaml_reader.h"
#include "exit_status.h"

namespace canopeer::app {
namespace {

/// "[a, b]" as YAML has it.
std::string yaml_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "[" : ", ") + text;
  return list.empty() ? "[]" : list + "]";
}

void add_parameters(YamlMap map, const std::string& prefix, Overrides& settings) {
  for (const std::string& key : map.keys()) {
    if (map.is_text(key)) {
      settings.emplace_back(prefix + key, map.text(key, {}));
    } else if (map.is_map(key)) {
      add_parameters(map.map(key), prefix + key + ".", settings);
    } else {
      settings.emplace_back(prefix + key, yaml_list(map.texts(key, {})));
    }
  }
}

/// Those of the node, and those of all ("/**").
void add_parameter_file(const std::string& path, const ros::NodeOptions& node,
                        Overrides& settings) {
  YamlMap file = value_or_stop(YamlMap::load(path), kBadInput);
  const std::string full = (node.ns == "/" ? "" : node.ns) + "/" + node.name;
  for (const std::string& name : {std::string("/**"), node.name, full}) {
    if (!file.has(name)) continue;
    add_parameters(file.map(name).map("ros__parameters"), "ros2.", settings);
  }
}

}  // namespace

ros::RosArguments take_ros_arguments(int argc, char** argv) {
  return value_or_stop(ros::RosArguments::parse({argv, argv + argc}), kBadInput);
}

Overrides ros2_settings(const ros::RosArguments& arguments, const std::string& node) {
  ros::NodeOptions options;
  options.name = node;
  arguments.apply(options);
  Overrides settings;
  if (arguments.node) settings.emplace_back("ros2.node", options.name);
  if (arguments.ns) settings.emplace_back("ros2.namespace", options.ns);
  for (const auto& [from, to] : options.remaps) settings.emplace_back("ros2.remaps." + from, to);
  for (const std::string& file : arguments.parameter_files) {
    add_parameter_file(file, options, settings);
  }
  for (const auto& [name, value] : arguments.settings_of(options.name)) {
    settings.emplace_back("ros2." + name, value);
  }
  return settings;
}

void take_ros_domain(MissionFile& file) {
  const char* const said = std::getenv("ROS_DOMAIN_ID");
  if (said == nullptr) return;
  const auto domain = value_or_stop(ros::domain_from(said), kBadInput);
  if (!domain) return;
  if (!file.ros2) file.ros2.emplace();
  if (!file.ros2->domain) file.ros2->domain = *domain;
}

}  // namespace canopeer::app
