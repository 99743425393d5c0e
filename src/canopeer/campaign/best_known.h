#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/campaign/run_figures.h"
#include "canopeer/record/yardstick.h"

namespace canopeer {

/// Where the yardstick of a mission, the seed of its world, and a protocol lies below records/.
[[nodiscard]] std::filesystem::path mission_record(const std::string& mission,
                                                   std::uint64_t world_seed,
                                                   const std::string& protocol);
/// The same of a world of CanopeerBench.
[[nodiscard]] std::filesystem::path suite_record(const std::string& world,
                                                 const std::string& protocol);

/// Nothing when there is no such file. Error: it cannot be read.
[[nodiscard]] Expected<std::optional<Yardstick>> known_yardstick(const std::filesystem::path& path);

/// More fruits, or as many with a greater AUC.
[[nodiscard]] bool finds_more(const BestResult& a, const BestResult& b);

/// What was found anew on a world, with the better of both best results.
[[nodiscard]] Yardstick with_better_of(Yardstick found, const Yardstick& known);

/// The yardstick with the run as best known, of fruits (more of them, then a greater AUC) or of
/// AUC; nothing when it beats neither. The world's part must be filled in. `version`: of Canopeer.
[[nodiscard]] std::optional<Yardstick> improved_by(const Yardstick& known, const RunFigures& run,
                                                   const std::string& version,
                                                   const std::vector<std::string>& settings = {});

/// What contradicts itself in a yardstick, one sentence each: a result above a bound, the best
/// known below the clairvoyant, more fruits than there are. Empty: nothing.
[[nodiscard]] std::vector<std::string> contradictions(const Yardstick& yardstick);

}  // namespace canopeer
