#pragma once

#include "canopeer/cdr/messages/diagnostic_msgs.h"
#include "canopeer/dds/node.h"

namespace canopeer::ros {

/// "NODE: network": domain, who else is there, payloads that were no messages.
[[nodiscard]] diagnostic_msgs::DiagnosticStatus network_diagnostics(Node& node);

}  // namespace canopeer::ros
