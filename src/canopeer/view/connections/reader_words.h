#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "canopeer/mission/steering.h"

namespace canopeer {

/// The first frame of a reader's (docs/formats.md): what it looks at, whether it may steer, how
/// many frames there are already.
[[nodiscard]] std::string greeting_frame(bool live, bool may_steer, std::size_t frames);

/// How much quicker than it happened a replay is shown.
[[nodiscard]] std::string pace_frame(double speed);

/// How many pictures were left out.
[[nodiscard]] std::string lost_frame(std::int64_t frames);

/// What a reader may ask for: to steer the mission, or another speed (0 … 10⁶). Empty where `text`
/// is no word of ours.
using ReaderWord = std::variant<SteeringWord::Kind, double>;
[[nodiscard]] std::optional<ReaderWord> reader_word(const std::string& text);

}  // namespace canopeer
