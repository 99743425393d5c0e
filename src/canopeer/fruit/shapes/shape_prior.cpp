#include "canopeer/fruit/shapes/shape_prior.h"

namespace canopeer {

Expected<void> ShapePrior::validate() const {
  const double values[] = {
      radius_m,    radius_sd_m, half_length_m, half_length_sd_m, out_of_round_sd_m, e1, e2,
      exponent_sd, tilt_sd_rad, surface_sd_m,  effective_points, normal_centre_sd_m};
  for (const double value : values) {
    if (!(value > 0.0)) return fail("every value of the shape prior must be positive");
  }
  if (e1 >= 2.0 || e2 >= 2.0) return fail("exponents must be below 2");
  return {};
}

}  // namespace canopeer
