#pragma once

#include <optional>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/record/summary.h"
#include "canopeer/record/yardstick.h"

namespace canopeer {

/// Name of the rules a mission has of its own, in yardsticks.
inline constexpr const char* kOwnProtocol = "own";

/// Fills the shares and gaps of `scores`. What the yardstick or the run does not tell, and a share
/// of nothing, is null.
void hold_against(const Yardstick& yardstick, RunScores& scores);

/// A run may be held against `yardstick`: the same mission, the same protocol, and as many fruits
/// (`fruits_total` null: not known yet). `world_seed` null: the world is the same for all seeds.
/// The error says what differs, without the file's name.
[[nodiscard]] Expected<void> check_fits(const Yardstick& yardstick, const std::string& mission,
                                        const std::string& protocol,
                                        const std::optional<std::uint64_t>& world_seed,
                                        const std::optional<int>& fruits_total);

}  // namespace canopeer
