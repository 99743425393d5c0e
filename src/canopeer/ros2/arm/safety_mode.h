#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "canopeer/dds/node.h"

namespace canopeer::ros {

/// Hears ur_dashboard_msgs/SafetyMode, which the driver says when it changes. Thread-safe.
class SafetyMode {
 public:
  /// `node` outlives it.
  [[nodiscard]] static Expected<std::unique_ptr<SafetyMode>> make(Node& node,
                                                                  const std::string& topic);
  /// What keeps the arm from moving: "protective stop", …; nothing: it may move, or nothing was
  /// said yet.
  [[nodiscard]] std::optional<std::string> stop() const;
  void take(std::uint8_t mode) { mode_ = mode; }

 private:
  std::atomic<std::uint8_t> mode_{0};
  Subscription subscription_;
};

}  // namespace canopeer::ros
