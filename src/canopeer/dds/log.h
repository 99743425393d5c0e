#pragma once

#include <functional>
#include <optional>
#include <string>

#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/dds/node.h"

namespace canopeer::ros {

/// As rcl_interfaces/msg/Log has them.
enum class LogLevel : std::uint8_t { debug = 10, info = 20, warn = 30, error = 40, fatal = 50 };

/// What a node has to say, on /rosout; who comes late gets the last thousand. Thread-safe. Goes
/// before its node.
class Log {
 public:
  /// `now` stamps the messages. What is less than `least` is not said.
  [[nodiscard]] static Expected<Log> make(Node& node, std::function<builtin_interfaces::Time()> now,
                                          LogLevel least = LogLevel::info);
  void say(LogLevel level, const std::string& text) const;

 private:
  std::string name_;
  LogLevel least_ = LogLevel::info;
  std::function<builtin_interfaces::Time()> now_;
  Publisher<rcl_interfaces::Log> out_;
};

/// "debug" … "fatal"; nothing for another text.
[[nodiscard]] std::optional<LogLevel> log_level_from(const std::string& text);

}  // namespace canopeer::ros
