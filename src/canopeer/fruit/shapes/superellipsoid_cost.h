#pragma once

#include <memory>
#include <span>

#include "canopeer/base/simd_level.h"
#include "canopeer/fruit/shapes/shape_prior.h"
#include "canopeer/geometry/superellipsoid.h"

namespace canopeer {

/// The unknowns of a fit: a, b, c, e1, e2, the centre (world), and a rotation vector w that turns a
/// reference orientation: R = exp([w]) R_reference.
inline constexpr int kFitParameters = 11;
using FitParameters = Eigen::Matrix<double, kFitParameters, 1>;

[[nodiscard]] Superellipsoid body_of(const FitParameters& parameters,
                                     const Eigen::Matrix3d& reference);
/// w = 0: the reference is the body's own orientation.
[[nodiscard]] FitParameters parameters_of(const Superellipsoid& body);

/// What a step and a report need of all residuals r and their derivatives J.
struct NormalEquations {
  /// [J r]ᵀ[J r]: JᵀJ and Jᵀr of the normal equations, and rᵀr in the last place.
  Eigen::Matrix<double, kFitParameters + 1, kFitParameters + 1> products;
  /// Σ d² over the points, d their radial distances, each clipped at kClippedDistanceM.
  double distances_m2 = 0.0;
};
/// Of the reported spread: one stray point is not all.
inline constexpr double kClippedDistanceM = 0.01;

class ChunkedPoints;

/// What a fit minimises, with its derivative: ½ |r|², r = a robust residual for every point, then
/// those of the prior. Everything is in standard deviations, so ½ |r|² is minus the log posterior.
class SuperellipsoidCost {
 public:
  /// `centre_vote`: where the normals see the centre. `level`: changes the speed only.
  SuperellipsoidCost(std::span<const SurfacePoint> surface, const ShapePrior& prior,
                     const Vec3& centre_vote, const Eigen::Matrix3d& reference,
                     SimdLevel level = best_simd_level());
  ~SuperellipsoidCost();

  static constexpr int kPriorResiduals = 11;
  [[nodiscard]] int points() const;
  [[nodiscard]] int residuals() const { return points() + kPriorResiduals; }

  /// r of length residuals(); `jacobian` row-major residuals() × 11, null: not wanted.
  void evaluate(const double* parameters, double* r, double* jacobian) const;

  /// The sums over what evaluate() gives, without the thousands of numbers in between.
  [[nodiscard]] NormalEquations normal_equations(const FitParameters& p) const;

 private:
  /// Calls take(number of points, their rows) chunk by chunk.
  template <typename Take>
  void for_each_chunk(const FitParameters& p, const Take& take) const;
  void evaluate_prior(const FitParameters& p, double* r, double* jacobian) const;

  std::unique_ptr<const ChunkedPoints> points_;  // world
  ShapePrior prior_;
  Vec3 centre_vote_;
  Eigen::Matrix3d reference_;
  double weight_;  // of one point: 1 / sd, less where points repeat each other
  SimdLevel level_;
};

}  // namespace canopeer
