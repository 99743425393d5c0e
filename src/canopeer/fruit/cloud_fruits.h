#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/sensing/point_cloud.h"

namespace canopeer {

/// How fruits are found in a cloud, and their shapes fitted.
struct CloudFitOptions {
  FruitMapOptions fruit;           ///< of its surface only the clustering, shapes and limits count
  double cell_m = 0.004;           ///< points are thinned to one in a cell of this size
  double normal_radius_m = 0.015;  ///< of missing normals (Marangoz et al., CASE 2022)
  bool upright = true;             ///< z is up and fruits hang; false: any orientation
  int fit_points = 1000;
};

/// The fruits of a cloud, and what of the cloud each is made of.
struct CloudFruits {
  PointCloud surface;      ///< thinned, with normals; colours when the cloud has any
  std::vector<int> fruit;  ///< id of the fruit each point of `surface` belongs to, −1: none
  std::vector<FruitEstimate> fruits;
  std::vector<std::vector<Vec3>> missing;  ///< of each fruit: points of its shape nobody saw
  std::vector<std::string> notices;        ///< points left out, and how many
};

/// Finds the fruits in a cloud of fruit surface points and fits their shapes, as the fruit map
/// does. Colours, where there are any, tell the ripeness. Points that are not finite, a few beyond
/// 2 km, and those at the origin when there are several, are left out and counted in the notices.
/// `viewpoint`: where they were seen from. The error says why there is nothing to fit: no points,
/// none finite, too few, coordinates that cannot be metres.
[[nodiscard]] Expected<CloudFruits> fit_cloud(const PointCloud& cloud,
                                              const CloudFitOptions& options = {},
                                              const std::optional<Vec3>& viewpoint = {});

}  // namespace canopeer
