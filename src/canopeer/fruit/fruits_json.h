#pragma once

#include <string>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer {

/// `fruits.json`: an object with `unit` and the array `fruits`, the same fields as fruits.csv but
/// in objects (centre_m, axes_m …); a fruit in no row has `place` null. Ends in a newline.
[[nodiscard]] std::string fruits_json(const std::vector<FruitEstimate>& fruits);

}  // namespace canopeer
