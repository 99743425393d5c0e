#pragma once

#include <vector>

#include "canopeer/base/simd_level.h"
#include "canopeer/fruit/shapes/superellipsoid_cost.h"

namespace canopeer {

/// Points in chunks. A chunk has as many as their intermediate values fit the cache; the last one
/// is filled up with zeros. Point i of a chunk lies at place_in_chunk(i): so sums over rows of four
/// add the points up as a sum by halves would.
class ChunkedPoints {
 public:
  static constexpr int kChunk = 32;
  struct alignas(32) Chunk {
    double x[kChunk] = {};
    double y[kChunk] = {};
    double z[kChunk] = {};
    int points = 0;
  };

  explicit ChunkedPoints(std::span<const SurfacePoint> surface);

  [[nodiscard]] const std::vector<Chunk>& chunks() const { return chunks_; }
  [[nodiscard]] int points() const { return points_; }
  static int place_in_chunk(int i) { return (i >> 1 & 7) * 4 + (i >> 4 & 1) * 2 + (i & 1); }

 private:
  std::vector<Chunk> chunks_;
  int points_ = 0;
};

/// Of a chunk's points: the derivatives of their residuals by the parameters, the residuals, and
/// the radial distances, m. Those of points that fill a chunk up are zero.
struct alignas(32) RadialRows {
  static constexpr int kResidual = kFitParameters;
  static constexpr int kDistance = kFitParameters + 1;
  double column[kFitParameters + 2][ChunkedPoints::kChunk];
};

/// What all points of a fit have in common.
struct RadialModel {
  FitParameters parameters;
  Eigen::Matrix3d rotation;  ///< T_world_body
  Eigen::Matrix3d turn;      ///< from a turn in the body's frame to the rotation vector
  double weight = 1.0;       ///< of one residual
  double surface_sd_m = 1.0;
};

/// The radial distance is d = m (1 − 1/G): m is the distance from the centre, G = F^(e1/2) the
/// gauge. Its derivatives follow by the chain rule through log G: each is a share of the terms of
/// F. The Cauchy loss as a residual: ½ r² = ½ c² log(1 + (d/sd)²/c²) (Triggs et al. 2000). `level`
/// changes the speed only.
void radial_rows(const ChunkedPoints::Chunk& chunk, const RadialModel& model, RadialRows& rows,
                 SimdLevel level);

/// Adds up over the rows: the upper triangle of [J r]ᵀ[J r], and the clipped distances' squares.
void add_products(const RadialRows& rows, NormalEquations& sum, SimdLevel level);

}  // namespace canopeer
