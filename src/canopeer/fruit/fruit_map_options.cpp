#include "canopeer/fruit/fruit_map_options.h"

namespace canopeer {

Expected<void> FruitMapOptions::validate() const {
  if (auto ok = tsdf.validate(); !ok) return fail_in("tsdf", ok.error());
  if (!(min_fruit_share > 0.0) || min_fruit_share > 1.0) {
    return fail("min_fruit_share must be in (0, 1]");
  }
  if (!(cluster_tolerance_m >= tsdf.voxel_m)) {
    return fail("cluster_tolerance_m must be at least voxel_m");
  }
  if (min_cluster_points < 1 || min_points < min_cluster_points) {
    return fail("1 <= min_cluster_points <= min_points must hold");
  }
  if (!(min_radius_m > 0.0) || max_radius_m <= min_radius_m) {
    return fail("0 < min_radius_m < max_radius_m must hold");
  }
  if (auto ok = prior.validate(); !ok) return fail_in("prior", ok.error());
  if (min_normal_spread < 0.0 || min_normal_spread > 1.0) {
    return fail("min_normal_spread must be in [0, 1]");
  }
  if (min_curvature_radius_m < 0.0) return fail("min_curvature_radius_m must not be negative");
  if (!(max_piece_m > 0.0)) return fail("max_piece_m must be positive");
  if (!(max_rms_m > 0.0)) return fail("max_rms_m must be positive");
  if (!(min_centre_distance_m > 0.0)) return fail("min_centre_distance_m must be positive");
  if (!(id_distance_m > 0.0)) return fail("id_distance_m must be positive");
  if (fit_points < 20 || refit_points < 20) {
    return fail("fit_points and refit_points must be at least 20");
  }
  if (update_points < 1 || update_blocks < 1) {
    return fail("update_points and update_blocks must be at least 1");
  }
  if (min_confidence < 0.0 || min_confidence > 1.0) return fail("min_confidence must be in [0, 1]");
  return {};
}

}  // namespace canopeer
