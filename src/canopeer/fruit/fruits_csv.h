#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer {

/// `fruits.csv`: one row per fruit in the given order; columns in docs/formats.md. A fruit in no
/// row has its last four fields empty.
[[nodiscard]] std::string fruits_csv(const std::vector<FruitEstimate>& fruits);

/// The error names file, line and column. Of a file without the columns after `confidence` the rest
/// keeps its defaults.
[[nodiscard]] Expected<std::vector<FruitEstimate>> read_fruits_csv(
    const std::filesystem::path& path);

}  // namespace canopeer
