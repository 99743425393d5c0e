#pragma once

#include <string>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer {

/// `fruits.json`: an object with `unit` and the array `fruits`. The fields are those of fruits.csv,
/// but in objects (centre_m, semi_axes_m …). A fruit in no row has `place` null. Ends in a newline.
[[nodiscard]] std::string fruits_json(const std::vector<FruitEstimate>& fruits);

}  // namespace canopeer
