#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "canopeer/mission/steering.h"

namespace canopeer {

// What goes to and from readers besides the frames of a run (docs/live-view.md).

/// A reader's first frame: is the run still going on, may it steer, how many frames are there.
[[nodiscard]] std::string greeting_frame(bool live, bool may_steer, std::size_t frames);

/// `speed` in mission seconds a second; 0: as fast as it goes.
[[nodiscard]] std::string pace_frame(double speed);

/// So many frames were left out for this reader.
[[nodiscard]] std::string lost_frame(std::int64_t frames);

/// What a reader may ask for: to steer the mission, or another speed (mission seconds a second,
/// 0 … 10⁶). Empty where `text` is no word of ours.
using ReaderWord = std::variant<SteeringWord::Kind, double>;
[[nodiscard]] std::optional<ReaderWord> reader_word(const std::string& text);

}  // namespace canopeer
