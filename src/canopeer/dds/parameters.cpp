#include "canopeer/dds/parameters.h"

#include <utility>

#include "canopeer/dds/parameter_table.h"

namespace canopeer::ros {
namespace {

using rcl_interfaces::DescribeParameters;
using rcl_interfaces::GetParameters;
using rcl_interfaces::GetParameterTypes;
using rcl_interfaces::ListParameters;
using rcl_interfaces::ParameterEvent;
using rcl_interfaces::ParameterType;
using rcl_interfaces::SetParameters;
using rcl_interfaces::SetParametersAtomically;

constexpr Qos kEventQos{true, false, 1000};

class NodeParameters final : public Parameters {
 public:
  NodeParameters(Node& node, std::vector<ParameterAccess> parameters,
                 std::function<builtin_interfaces::Time()> now)
      : node_(node), table_(std::move(parameters)), now_(std::move(now)) {}

  [[nodiscard]] Expected<void> open() {
    if (const auto valid = table_.validate(); !valid) return valid;
    auto events = node_.advertise<ParameterEvent>("/parameter_events", kEventQos);
    if (!events) return tl::unexpected(events.error());
    events_ = std::move(*events);
    Expected<void> opened;
    serve<DescribeParameters>("~/describe_parameters", opened, [this](auto&& request) {
      DescribeParameters::Response response;
      for (const auto& name : request.names) response.descriptors.push_back(table_.describe(name));
      return response;
    });
    serve<GetParameters>("~/get_parameters", opened, [this](auto&& request) {
      GetParameters::Response response;
      for (const auto& name : request.names) response.values.push_back(table_.get(name));
      return response;
    });
    serve<GetParameterTypes>("~/get_parameter_types", opened, [this](auto&& request) {
      GetParameterTypes::Response response;
      for (const auto& name : request.names) response.types.push_back(table_.get(name).type);
      return response;
    });
    serve<ListParameters>("~/list_parameters", opened, [this](auto&& request) {
      return ListParameters::Response{table_.list(request)};
    });
    serve<SetParameters>("~/set_parameters", opened, [this](auto&& request) {
      SetParameters::Response response;
      for (const auto& to : request.parameters) {
        response.results.push_back(table_.set(to));
        if (response.results.back().successful) changed(to.name);
      }
      return response;
    });
    serve<SetParametersAtomically>("~/set_parameters_atomically", opened, [this](auto&& request) {
      SetParametersAtomically::Response response{table_.set_all(request.parameters)};
      for (const auto& to : request.parameters) {
        if (response.result.successful) changed(to.name);
      }
      return response;
    });
    return opened;
  }

  void changed(const std::string& name) override {
    ParameterEvent event;
    event.stamp = now_();
    event.node = node_.full_name();
    event.changed_parameters.push_back({name, table_.get(name)});
    events_.publish(event);
  }

 private:
  /// A service whose answer is made at once.
  template <class S, class Answer>
  void serve(const std::string& name, Expected<void>& opened, Answer answer) {
    if (!opened) return;
    auto server = Server<S>::make(node_, name, [answer](typename S::Request&& request, auto reply) {
      reply(answer(request));
    });
    if (!server) {
      opened = tl::unexpected(server.error());
    } else {
      servers_.push_back(std::make_shared<Server<S>>(std::move(*server)));
    }
  }

  Node& node_;
  const ParameterTable table_;
  const std::function<builtin_interfaces::Time()> now_;
  Publisher<ParameterEvent> events_;
  std::vector<std::shared_ptr<void>> servers_;  ///< go first: they use the above
};

}  // namespace

ParameterValue parameter_value(bool value) {
  ParameterValue made;
  made.type = ParameterType::PARAMETER_BOOL;
  made.bool_value = value;
  return made;
}

ParameterValue parameter_value(std::int64_t value) {
  ParameterValue made;
  made.type = ParameterType::PARAMETER_INTEGER;
  made.integer_value = value;
  return made;
}

ParameterValue parameter_value(double value) {
  ParameterValue made;
  made.type = ParameterType::PARAMETER_DOUBLE;
  made.double_value = value;
  return made;
}

ParameterValue parameter_value(std::string value) {
  ParameterValue made;
  made.type = ParameterType::PARAMETER_STRING;
  made.string_value = std::move(value);
  return made;
}

ParameterValue parameter_value(std::vector<std::string> value) {
  ParameterValue made;
  made.type = ParameterType::PARAMETER_STRING_ARRAY;
  made.string_array_value = std::move(value);
  return made;
}

Expected<std::unique_ptr<Parameters>> Parameters::make(
    Node& node, std::vector<ParameterAccess> parameters,
    std::function<builtin_interfaces::Time()> now) {
  auto made = std::make_unique<NodeParameters>(node, std::move(parameters), std::move(now));
  const auto opened = made->open();
  if (!opened) return tl::unexpected(opened.error());
  return made;
}

}  // namespace canopeer::ros
