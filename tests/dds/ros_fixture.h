#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "canopeer/dds/node.h"
#include "support/own_network.h"

namespace canopeer::ros::testing_support {

/// Polls; the deadline is there for what never comes.
inline bool eventually(const std::function<bool()>& holds,
                       std::chrono::seconds deadline = std::chrono::seconds(30)) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

inline NodeOptions options_of(const std::string& name) {
  NodeOptions options;
  options.name = name;
  options.participant.name = name;
  options.participant.domain = canopeer::testing_support::own_domain();
  return options;
}

inline std::unique_ptr<Node> make_node(const NodeOptions& options) {
  auto node = Node::make(options);
  if (!node) {
    ADD_FAILURE() << node.error().message;
    return nullptr;
  }
  return std::move(*node);
}
inline std::unique_ptr<Node> make_node(const std::string& name) {
  return make_node(options_of(name));
}

}  // namespace canopeer::ros::testing_support
