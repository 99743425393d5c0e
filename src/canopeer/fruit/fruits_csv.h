#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer {

/// `fruits.csv`: one row per fruit in the given order, columns `id, x_m, y_m, z_m, a_m, b_m, c_m,
/// e1, e2, roll_rad, pitch_rad, yaw_rad, volume_cm3, points, confidence`.
[[nodiscard]] std::string fruits_csv(const std::vector<FruitEstimate>& fruits);

/// The error names file, line and column.
[[nodiscard]] Expected<std::vector<FruitEstimate>> read_fruits_csv(
    const std::filesystem::path& path);

}  // namespace canopeer
