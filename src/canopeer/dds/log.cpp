#include "canopeer/dds/log.h"

#include <algorithm>
#include <utility>

namespace canopeer::ros {
namespace {

constexpr Qos kRosoutQos{true, true, 1000};

/// "/left_row/canopeer" → "left_row.canopeer", as loggers are named.
std::string logger_name(std::string full) {
  full.erase(0, 1);
  std::replace(full.begin(), full.end(), '/', '.');
  return full;
}

}  // namespace

Expected<Log> Log::make(Node& node, std::function<builtin_interfaces::Time()> now, LogLevel least) {
  auto out = node.advertise<rcl_interfaces::Log>("/rosout", kRosoutQos);
  if (!out) return tl::unexpected(out.error());
  Log log;
  log.name_ = logger_name(node.full_name());
  log.least_ = least;
  log.now_ = std::move(now);
  log.out_ = std::move(*out);
  return log;
}

void Log::say(LogLevel level, const std::string& text) const {
  if (level < least_) return;
  rcl_interfaces::Log message;
  message.stamp = now_();
  message.level = static_cast<std::uint8_t>(level);
  message.name = name_;
  message.msg = text;
  out_.publish(message);
}

std::optional<LogLevel> log_level_from(const std::string& text) {
  if (text == "debug") return LogLevel::debug;
  if (text == "info") return LogLevel::info;
  if (text == "warn") return LogLevel::warn;
  if (text == "error") return LogLevel::error;
  if (text == "fatal") return LogLevel::fatal;
  return std::nullopt;
}

}  // namespace canopeer::ros
