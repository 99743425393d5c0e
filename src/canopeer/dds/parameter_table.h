#pragma once

#include <string>
#include <vector>

#include "canopeer/dds/parameters.h"

namespace canopeer::ros {

/// What the parameter services answer, without the services.
class ParameterTable {
 public:
  explicit ParameterTable(std::vector<ParameterAccess> parameters)
      : parameters_(std::move(parameters)) {}
  [[nodiscard]] Expected<void> validate() const;
  /// Not set: there is no such parameter.
  [[nodiscard]] ParameterValue get(const std::string& name) const;
  [[nodiscard]] rcl_interfaces::ParameterDescriptor describe(const std::string& name) const;
  /// Names under the prefixes (none: all), down to so many dots (0: all), as ROS lists them.
  [[nodiscard]] rcl_interfaces::ListParametersResult list(
      const rcl_interfaces::ListParameters::Request& request) const;
  [[nodiscard]] rcl_interfaces::SetParametersResult set(const rcl_interfaces::Parameter& to) const;
  /// All of them or none.
  [[nodiscard]] rcl_interfaces::SetParametersResult set_all(
      const std::vector<rcl_interfaces::Parameter>& to) const;

 private:
  [[nodiscard]] const ParameterAccess* find(const std::string& name) const;
  /// The value as the parameter takes it; the error is why it does not.
  [[nodiscard]] Expected<ParameterValue> accepted(const rcl_interfaces::Parameter& to) const;

  std::vector<ParameterAccess> parameters_;
};

}  // namespace canopeer::ros
