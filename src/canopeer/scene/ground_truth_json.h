#pragma once

#include <string>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// The ground truth as one JSON object: `name`, `seed`, `imported`, `fruits_counted`, and `fruits`,
/// a list of objects with the columns of ground_truth_csv() and, of imported scenes, the model's
/// full name.
std::string ground_truth_json(const Scene& scene);

}  // namespace canopeer
