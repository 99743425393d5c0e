#include "canopeer/ros2/out/network_diagnostics.h"

namespace canopeer::ros {

diagnostic_msgs::DiagnosticStatus network_diagnostics(Node& node) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::int64_t malformed = node.malformed();
  DiagnosticStatus status;
  status.level = malformed > 0 ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  status.name = node.options().name + ": network";
  status.message = malformed > 0 ? "messages that were none of their type were dropped"
                                 : "all messages could be read";
  status.values = {{"domain", std::to_string(node.options().participant.domain)},
                   {"other participants", std::to_string(node.participant().peers().size())},
                   {"malformed messages", std::to_string(malformed)},
                   {"library", dds_library()}};
  return status;
}

}  // namespace canopeer::ros
