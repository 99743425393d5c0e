#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/dds/service.h"

namespace canopeer::ros {

using rcl_interfaces::ParameterValue;

[[nodiscard]] ParameterValue parameter_value(bool value);
[[nodiscard]] ParameterValue parameter_value(std::int64_t value);
[[nodiscard]] ParameterValue parameter_value(double value);
[[nodiscard]] ParameterValue parameter_value(std::string value);
[[nodiscard]] ParameterValue parameter_value(std::vector<std::string> value);

/// One parameter: where its value is read and, unless it is read-only, written.
struct ParameterAccess {
  std::string name;  ///< "arm.speed_scale"
  std::string description;
  std::function<ParameterValue()> get;
  /// Gets values of the type that `get` gives. The error is why not. None: read-only.
  std::function<Expected<void>(const ParameterValue&)> set;
  /// For numbers: what is outside is refused before `set` is asked. Both 0: no limits.
  double least = 0.0;
  double most = 0.0;
};

/// The parameter services of a node (`ros2 param list`, `get`, `set`, `describe`) and
/// /parameter_events. All accesses come from threads of the DDS library. Goes before its node.
class Parameters {
 public:
  /// `now` stamps events. The error: two parameters of one name, or services that were not made.
  [[nodiscard]] static Expected<std::unique_ptr<Parameters>> make(
      Node& node, std::vector<ParameterAccess> parameters,
      std::function<builtin_interfaces::Time()> now);
  virtual ~Parameters() = default;
  /// Says on /parameter_events that a value changed by other means than the services.
  virtual void changed(const std::string& name) = 0;
};

}  // namespace canopeer::ros
