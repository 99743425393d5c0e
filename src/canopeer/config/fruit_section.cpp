#include "canopeer/config/fruit_section.h"

#include <cmath>
#include <numbers>

namespace canopeer {

void read_fruit(YamlMap& file, FruitMapOptions& o) {
  YamlMap fruit = file.map("fruit");
  o.tsdf.voxel_m = fruit.number("voxel_m", o.tsdf.voxel_m, {0.0005, 0.02});
  o.tsdf.truncation_m = fruit.number("truncation_m", 3.0 * o.tsdf.voxel_m, {0.001, 0.16});
  o.tsdf.max_range_m = fruit.number("max_range_m", o.tsdf.max_range_m, {0.1, 20.0});
  o.min_confidence = fruit.number("min_confidence", o.min_confidence, {0.0, 1.0});
  o.cluster_tolerance_m = fruit.number("cluster_tolerance_m", o.cluster_tolerance_m, {0.001, 0.1});
  o.fit_points = fruit.integer("fit_points", o.fit_points, 20, 100000);
  o.refit_points = fruit.integer("refit_points", o.refit_points, 20, 100000);
  o.update_blocks = fruit.integer("update_blocks", o.update_blocks, 1, FruitMapOptions::kNoBound);
  o.update_points = fruit.integer("update_points", o.update_points, 1, FruitMapOptions::kNoBound);
  o.prior.radius_m = fruit.number("radius_m", o.prior.radius_m, {0.02, 0.15});
  o.prior.radius_sd_m = fruit.number("radius_sd_m", o.prior.radius_sd_m, {0.0001, 0.1});
  o.prior.half_length_m = fruit.number("half_length_m", o.prior.half_length_m, {0.02, 0.15});
  o.prior.half_length_sd_m =
      fruit.number("half_length_sd_m", o.prior.half_length_sd_m, {0.0001, 0.1});
  o.prior.surface_sd_m = fruit.number("surface_sd_m", o.prior.surface_sd_m, {0.0001, 0.05});
  if (auto ok = o.validate(); !ok) fruit.complain("voxel_m", ok.error().message);
  for (YamlMap& map : file.maps("rows")) {
    PlantRow row;
    row.name = map.required_text("name");
    row.start = {map.required_number("x_m", {-1e4, 1e4}), map.required_number("y_m", {-1e4, 1e4}),
                 map.number("z_m", 0.0, {-100.0, 100.0})};
    const double heading =
        map.number("heading_deg", 90.0, {-360.0, 360.0}) * std::numbers::pi / 180.0;
    row.direction = {std::cos(heading), std::sin(heading), 0.0};
    o.rows.push_back(row);
  }
}

}  // namespace canopeer
