#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "canopeer/mission/event.h"

namespace canopeer::ros {

/// A line of a log.
struct EventWords {
  std::uint8_t level = 0;  ///< of rcl_interfaces/msg/Log
  std::string text;
};

/// What a person who reads /rosout wants to know of an event; nothing for most.
[[nodiscard]] std::optional<EventWords> words_of(const Event& event);

}  // namespace canopeer::ros
