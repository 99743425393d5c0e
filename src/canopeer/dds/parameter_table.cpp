#include "canopeer/dds/parameter_table.h"

#include <algorithm>
#include <set>
#include <utility>

namespace canopeer::ros {
namespace {

using rcl_interfaces::ListParameters;
using rcl_interfaces::ListParametersResult;
using rcl_interfaces::Parameter;
using rcl_interfaces::ParameterDescriptor;
using rcl_interfaces::ParameterType;
using rcl_interfaces::SetParametersResult;

bool is_limited(const ParameterAccess& parameter) {
  return parameter.least != 0.0 || parameter.most != 0.0;
}

std::string type_name(std::uint8_t type) {
  static constexpr const char* kNames[] = {"nothing",  "a bool", "an integer", "a double",
                                           "a string", "bytes",  "bools",      "integers",
                                           "doubles",  "strings"};
  return type < std::size(kNames) ? kNames[type] : "an unknown type";
}

std::int64_t dots_in(const std::string& name) { return std::count(name.begin(), name.end(), '.'); }

bool is_listed(const std::string& name, const ListParameters::Request& request) {
  const auto within = [&](const std::string& rest) {
    return request.depth == 0 || dots_in(rest) < static_cast<std::int64_t>(request.depth);
  };
  if (request.prefixes.empty()) return within(name);
  return std::any_of(request.prefixes.begin(), request.prefixes.end(), [&](const auto& prefix) {
    if (name == prefix) return true;
    return name.starts_with(prefix + ".") && within(name.substr(prefix.size() + 1));
  });
}

SetParametersResult result_of(const Expected<void>& set) {
  return {set.has_value(), set ? "" : set.error().message};
}

}  // namespace

Expected<void> ParameterTable::validate() const {
  std::set<std::string> names;
  for (const ParameterAccess& parameter : parameters_) {
    if (!names.insert(parameter.name).second) {
      return fail("parameter '" + parameter.name + "' is there twice");
    }
  }
  return {};
}

ParameterValue ParameterTable::get(const std::string& name) const {
  const ParameterAccess* parameter = find(name);
  return parameter == nullptr ? ParameterValue{} : parameter->get();
}

ParameterDescriptor ParameterTable::describe(const std::string& name) const {
  ParameterDescriptor descriptor;
  descriptor.name = name;
  const ParameterAccess* parameter = find(name);
  if (parameter == nullptr) return descriptor;
  descriptor.type = parameter->get().type;
  descriptor.description = parameter->description;
  descriptor.read_only = !parameter->set;
  if (is_limited(*parameter) && descriptor.type == ParameterType::PARAMETER_DOUBLE) {
    descriptor.floating_point_range = {{parameter->least, parameter->most, 0.0}};
  }
  if (is_limited(*parameter) && descriptor.type == ParameterType::PARAMETER_INTEGER) {
    descriptor.integer_range = {{static_cast<std::int64_t>(parameter->least),
                                 static_cast<std::int64_t>(parameter->most), 0}};
  }
  return descriptor;
}

ListParametersResult ParameterTable::list(const ListParameters::Request& request) const {
  ListParametersResult listed;
  std::set<std::string> prefixes;
  for (const ParameterAccess& parameter : parameters_) {
    if (!is_listed(parameter.name, request)) continue;
    listed.names.push_back(parameter.name);
    const std::size_t last = parameter.name.rfind('.');
    if (last != std::string::npos) prefixes.insert(parameter.name.substr(0, last));
  }
  listed.prefixes.assign(prefixes.begin(), prefixes.end());
  return listed;
}

SetParametersResult ParameterTable::set(const Parameter& to) const {
  const auto value = accepted(to);
  if (!value) return {false, value.error().message};
  return result_of(find(to.name)->set(*value));
}

SetParametersResult ParameterTable::set_all(const std::vector<Parameter>& to) const {
  std::vector<std::pair<const ParameterAccess*, ParameterValue>> wanted;
  for (const Parameter& one : to) {
    auto value = accepted(one);
    if (!value) return {false, value.error().message};
    wanted.emplace_back(find(one.name), std::move(*value));
  }
  std::vector<std::pair<const ParameterAccess*, ParameterValue>> before;
  for (const auto& [parameter, value] : wanted) {
    ParameterValue old = parameter->get();
    const auto set = parameter->set(value);
    if (!set) {
      // What was accepted a moment ago is accepted again.
      for (auto it = before.rbegin(); it != before.rend(); ++it) {
        static_cast<void>(it->first->set(it->second));
      }
      return result_of(set);
    }
    before.emplace_back(parameter, std::move(old));
  }
  return {true, ""};
}

const ParameterAccess* ParameterTable::find(const std::string& name) const {
  const auto found =
      std::find_if(parameters_.begin(), parameters_.end(),
                   [&](const ParameterAccess& parameter) { return parameter.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

Expected<ParameterValue> ParameterTable::accepted(const Parameter& to) const {
  const ParameterAccess* parameter = find(to.name);
  if (parameter == nullptr) return fail("there is no parameter '" + to.name + "'");
  if (!parameter->set) return fail("'" + to.name + "' is read-only");
  ParameterValue value = to.value;
  const std::uint8_t type = parameter->get().type;
  if (type == ParameterType::PARAMETER_DOUBLE && value.type == ParameterType::PARAMETER_INTEGER) {
    value = parameter_value(static_cast<double>(value.integer_value));  // `ros2 param set x 1`
  }
  if (value.type != type) {
    return fail("'" + to.name + "' takes " + type_name(type) + ", not " + type_name(value.type));
  }
  if (is_limited(*parameter)) {
    const double number = type == ParameterType::PARAMETER_INTEGER
                              ? static_cast<double>(value.integer_value)
                              : value.double_value;
    if (!(number >= parameter->least && number <= parameter->most)) {
      return fail("'" + to.name + "' must be " + std::to_string(parameter->least) + " … " +
                  std::to_string(parameter->most));
    }
  }
  return value;
}

}  // namespace canopeer::ros
