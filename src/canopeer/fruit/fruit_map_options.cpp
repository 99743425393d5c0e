#include "canopeer/fruit/fruit_map_options.h"

namespace canopeer {

Expected<void> FruitMapOptions::validate() const {
  if (!(cell_m > 0.0) || cell_m > 0.05) return fail("cell_m must be in (0, 0.05]");
  if (!(max_range_m > 0.0)) return fail("max_range_m must be positive");
  if (min_cos_incidence < 0.0 || min_cos_incidence >= 1.0) {
    return fail("min_cos_incidence must be in [0, 1)");
  }
  if (!(normal_window_m > 0.0)) return fail("normal_window_m must be positive");
  if (!(max_depth_step_m > 0.0)) return fail("max_depth_step_m must be positive");
  if (min_hits < 1) return fail("min_hits must be at least 1");
  if (cluster_tolerance_m < cell_m) return fail("cluster_tolerance_m must be at least cell_m");
  if (cluster_tolerance_m > 20.0 * cell_m) {
    return fail("cluster_tolerance_m must be at most 20 cells");
  }
  if (group_distance_m < cluster_tolerance_m) {
    return fail("group_distance_m must be at least cluster_tolerance_m");
  }
  if (min_cluster_points < 1 || min_points < min_cluster_points) {
    return fail("1 <= min_cluster_points <= min_points must hold");
  }
  if (!(min_radius_m > 0.0) || max_radius_m <= min_radius_m) {
    return fail("0 < min_radius_m < max_radius_m must hold");
  }
  if (!(prior.radius_m > 0.0) || !(prior.radius_sd_m > 0.0) || !(prior.half_length_m > 0.0) ||
      !(prior.half_length_sd_m > 0.0) || !(prior.surface_sd_m > 0.0) ||
      !(prior.effective_points > 0.0) || !(prior.normal_centre_sd_m > 0.0)) {
    return fail("every value of the shape prior must be positive");
  }
  if (min_normal_spread < 0.0 || min_normal_spread > 1.0) {
    return fail("min_normal_spread must be in [0, 1]");
  }
  if (min_curvature_radius_m < 0.0) return fail("min_curvature_radius_m must not be negative");
  if (!(max_piece_m > 0.0)) return fail("max_piece_m must be positive");
  if (!(max_rms_m > 0.0)) return fail("max_rms_m must be positive");
  if (!(min_centre_distance_m > 0.0)) return fail("min_centre_distance_m must be positive");
  if (!(id_distance_m > 0.0)) return fail("id_distance_m must be positive");
  return {};
}

}  // namespace canopeer
