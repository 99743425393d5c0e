#include "canopeer/ros2/out/mission_parameters.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace canopeer::ros {
namespace {

using SettingJson = nlohmann::json;
using rcl_interfaces::ParameterType;

ParameterValue value_of_list(const SettingJson& list) {
  const auto all = [&](auto is_one) {
    return !list.empty() && std::all_of(list.begin(), list.end(), is_one);
  };
  ParameterValue value;
  if (all([](const SettingJson& j) { return j.is_boolean(); })) {
    value.type = ParameterType::PARAMETER_BOOL_ARRAY;
    value.bool_array_value = list.get<std::vector<bool>>();
  } else if (all([](const SettingJson& j) { return j.is_number_integer(); })) {
    value.type = ParameterType::PARAMETER_INTEGER_ARRAY;
    value.integer_array_value = list.get<std::vector<std::int64_t>>();
  } else if (all([](const SettingJson& j) { return j.is_number(); })) {
    value.type = ParameterType::PARAMETER_DOUBLE_ARRAY;
    value.double_array_value = list.get<std::vector<double>>();
  } else if (list.empty() || all([](const SettingJson& j) { return j.is_string(); })) {
    value.type = ParameterType::PARAMETER_STRING_ARRAY;
    value.string_array_value = list.get<std::vector<std::string>>();
  } else {
    return parameter_value(list.dump());
  }
  return value;
}

ParameterValue value_of(const SettingJson& json) {
  if (json.is_boolean()) return parameter_value(json.get<bool>());
  if (json.is_number_integer()) return parameter_value(json.get<std::int64_t>());
  if (json.is_number()) return parameter_value(json.get<double>());
  if (json.is_string()) return parameter_value(json.get<std::string>());
  if (json.is_array()) return value_of_list(json);
  return parameter_value(json.dump());
}

std::string parameter_name(const std::string& key) {
  constexpr std::string_view kSite = "ros2.";
  return key.starts_with(kSite) ? key.substr(kSite.size()) : "mission." + key;
}

}  // namespace

std::vector<ParameterAccess> mission_parameters(const std::string& settings_json,
                                                std::vector<ParameterAccess> live) {
  const SettingJson settings = SettingJson::parse(settings_json, nullptr, false);
  if (!settings.is_object()) return live;
  const std::size_t live_ones = live.size();
  for (const auto& [key, json] : settings.items()) {
    const std::string name = parameter_name(key);
    const auto end = live.begin() + static_cast<std::ptrdiff_t>(live_ones);
    if (std::any_of(live.begin(), end, [&](const auto& l) { return l.name == name; })) continue;
    ParameterAccess& access = live.emplace_back();
    access.name = name;
    access.description = "A setting of the mission; see docs/formats.md. It holds for the run.";
    access.get = [value = value_of(json)] { return value; };
  }
  return live;
}

}  // namespace canopeer::ros
