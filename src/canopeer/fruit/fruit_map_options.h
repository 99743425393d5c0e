#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/fruit/shape_estimate.h"

namespace canopeer {

struct FruitMapOptions {
  // Which pixels are taken, and how fine.
  double cell_m = 0.005;            ///< edge of a surface cell
  double max_range_m = 1.6;         ///< farther pixels (depth along the axis) are not taken
  double min_cos_incidence = 0.2;   ///< pixels seen at a flatter angle are not taken
  double normal_window_m = 0.006;   ///< half width of the patch a pixel's normal is fitted to
  double max_depth_step_m = 0.012;  ///< a pixel beside a larger step is at an edge and not taken
  int min_hits = 2;                 ///< pixels a cell needs before it counts

  // What is one piece of surface.
  double cluster_tolerance_m = 0.01;  ///< Euclidean clusters (Marangoz et al., CASE 2022)
  int min_cluster_points = 5;         ///< smaller fragments are noise
  double group_distance_m = 0.04;  ///< fragments within it (at most twice it) are solved together

  // What is one fruit.
  ShapePrior prior;
  int min_points = 25;          ///< surface cells a fruit needs; 25 cells of 5 mm are 6 cm²
  double min_radius_m = 0.017;  ///< smaller bodies are clips, not fruits
  double max_radius_m = 0.055;  ///< larger bodies are no fruits either
  double max_rms_m = 0.006;     ///< the surface must be about an ellipsoid
  double min_centre_distance_m = 0.045;   ///< closer centres are one fruit
  double min_normal_spread = 0.03;        ///< variance of the normals; below it: a flat thing
  double min_curvature_radius_m = 0.017;  ///< from points and normals alone; below it: a clip
  double max_piece_m = 0.22;    ///< a straight piece longer than this is a pipe, not fruits
  double min_height_m = 0.08;   ///< centres below it (world z) are on the floor
  double id_distance_m = 0.05;  ///< a fruit keeps its id when its centre moves less than this

  [[nodiscard]] Expected<void> validate() const;
};

}  // namespace canopeer
