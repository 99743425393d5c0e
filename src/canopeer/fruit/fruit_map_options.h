#pragma once

#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/confidence/confidence.h"
#include "canopeer/fruit/row_place.h"
#include "canopeer/fruit/shapes/superellipsoid_fit.h"
#include "canopeer/fruit/surface/fruit_tsdf.h"

namespace canopeer {

/// How a FruitMap works: surface, pieces, fruits, shapes, and bounds on an update.
struct FruitMapOptions {
  TsdfOptions tsdf;
  double min_fruit_share = 0.5;  ///< surface counts when so many of its pixels were taken for fruit

  // What is one piece of surface.
  double cluster_tolerance_m = 0.01;  ///< Euclidean clusters (Marangoz et al., CASE 2022)
  int min_cluster_points = 5;         ///< smaller fragments are noise

  // What is one fruit.
  ShapePrior prior;
  int min_points = 40;          ///< surface points a fruit needs; 40 cells of 4 mm are 6 cm²
  double min_radius_m = 0.017;  ///< smaller bodies are clips, not fruits
  double max_radius_m = 0.055;  ///< larger bodies are no fruits either
  double max_rms_m = 0.006;     ///< the surface must be about an ellipsoid
  double min_centre_distance_m = 0.045;   ///< closer centres are one fruit
  double min_normal_spread = 0.03;        ///< variance of the normals; below it: a flat thing
  double min_curvature_radius_m = 0.017;  ///< from points and normals alone; below it: a clip
  double max_piece_m = 0.22;   ///< a straight piece longer than this is a pipe, not fruits
  double min_height_m = 0.08;  ///< centres below it (world z) are on the floor
  double id_distance_m =
      0.05;  ///< a fruit that shares no surface with what it was keeps its id so far

  // Shape and report.
  int fit_points = 160;   ///< of a fruit's surface, evenly, for its shape
  int refit_points = 96;  ///< the same for shapes that are known already, until the run ends
  ConfidenceModel confidence;
  /// How much known surface one update draws anew (blocks) and looks at again (points; one patch at
  /// least). A frame on which much has changed then holds nobody up: what is left waits for the
  /// next. New surface and new fruits never wait. 3 000 points are about ten fruits.
  int update_blocks = kNoBound;
  int update_points = 3000;
  static constexpr int kNoBound = 100000000;
  double min_confidence = 0.5;  ///< less likely fruits are not reported
  std::vector<PlantRow> rows;   ///< for places in rows; none: no places

  [[nodiscard]] Expected<void> validate() const;
};

}  // namespace canopeer
