#pragma once

#include <string>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// "green", "turning" or "ripe".
const char* ripeness_name(Ripeness ripeness);

/// One row per fruit in the order of ids, with the header
/// `id,class,counted,x_m,y_m,z_m,length_m,diameter_m,volume_cm3,surface_cm2,plant`. class is green,
/// turning or ripe; counted is 1 or 0. An imported scene has `hull_volume_cm3` in place of
/// `volume_cm3`. In place of `plant` it has the name of the `model`; commas, quotes and control
/// characters in it become "_".
std::string ground_truth_csv(const Scene& scene);

}  // namespace canopeer
