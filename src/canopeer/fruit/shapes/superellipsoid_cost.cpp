#include "canopeer/fruit/shapes/superellipsoid_cost.h"

#include <algorithm>
#include <cmath>

#include "canopeer/fruit/shapes/radial_rows.h"

namespace canopeer {
namespace {

using Eigen::Matrix3d;

Matrix3d skew(const Vec3& w) {
  Matrix3d m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

Matrix3d exp_of(const Vec3& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Matrix3d::Identity() + skew(w);
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

/// exp([w + δ]) ≈ exp([J δ]) exp([w]): the left Jacobian of SO(3) (Solà et al. 2018, eq. 145).
Matrix3d left_jacobian(const Vec3& w) {
  const double angle2 = w.squaredNorm();
  const Matrix3d k = skew(w);
  if (angle2 < 1e-10) return Matrix3d::Identity() + 0.5 * k + k * k / 6.0;
  const double angle = std::sqrt(angle2);
  return Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle2 * k +
         (angle - std::sin(angle)) / (angle2 * angle) * k * k;
}

double point_weight(std::size_t points, const ShapePrior& prior) {
  const double share = std::min(1.0, prior.effective_points / std::max(1.0, double(points)));
  return std::sqrt(share);
}

}  // namespace

Superellipsoid body_of(const FitParameters& p, const Matrix3d& reference) {
  Superellipsoid body;
  body.semi_axes_m = p.head<3>();
  body.e1 = p[3];
  body.e2 = p[4];
  body.T_world_body.translation() = p.segment<3>(5);
  body.T_world_body.linear() = exp_of(p.tail<3>()) * reference;
  return body;
}

FitParameters parameters_of(const Superellipsoid& body) {
  FitParameters p;
  p << body.semi_axes_m, body.e1, body.e2, body.centre(), Vec3::Zero();
  return p;
}

SuperellipsoidCost::SuperellipsoidCost(std::span<const SurfacePoint> surface,
                                       const ShapePrior& prior, const Vec3& centre_vote,
                                       const Matrix3d& reference, SimdLevel level)
    : points_(std::make_unique<ChunkedPoints>(surface)),
      prior_(prior),
      centre_vote_(centre_vote),
      reference_(reference),
      weight_(point_weight(surface.size(), prior)),
      level_(level) {}

SuperellipsoidCost::~SuperellipsoidCost() = default;

int SuperellipsoidCost::points() const { return points_->points(); }

template <typename Take>
void SuperellipsoidCost::for_each_chunk(const FitParameters& p, const Take& take) const {
  RadialModel model;
  model.parameters = p;
  model.rotation = exp_of(p.tail<3>()) * reference_;
  model.turn = left_jacobian(p.tail<3>()).transpose() * model.rotation;
  model.weight = weight_;
  model.surface_sd_m = prior_.surface_sd_m;
  RadialRows rows;
  for (const ChunkedPoints::Chunk& chunk : points_->chunks()) {
    radial_rows(chunk, model, rows, level_);
    take(chunk.points, rows);
  }
}

void SuperellipsoidCost::evaluate(const double* parameters, double* r, double* jacobian) const {
  const FitParameters p = Eigen::Map<const FitParameters>(parameters);
  double* const prior_jacobian =
      jacobian == nullptr ? nullptr : jacobian + std::ptrdiff_t{points()} * kFitParameters;
  evaluate_prior(p, r + points(), prior_jacobian);
  for_each_chunk(p, [&](int n, const RadialRows& rows) {
    for (int i = 0; i < n; ++i) {
      const int place = ChunkedPoints::place_in_chunk(i);
      *r++ = rows.column[RadialRows::kResidual][place];
      if (jacobian == nullptr) continue;
      for (int k = 0; k < kFitParameters; ++k) *jacobian++ = rows.column[k][place];
    }
  });
}

NormalEquations SuperellipsoidCost::normal_equations(const FitParameters& p) const {
  NormalEquations sum;
  auto& products = sum.products;
  products.setZero();
  for_each_chunk(p, [&](int, const RadialRows& rows) { add_products(rows, sum, level_); });
  Eigen::Matrix<double, kPriorResiduals, 1> r;
  Eigen::Matrix<double, kPriorResiduals, kFitParameters, Eigen::RowMajor> j;
  evaluate_prior(p, r.data(), j.data());
  Eigen::Matrix<double, kPriorResiduals, kFitParameters + 1> prior;
  prior << j, r;
  products.noalias() += prior.transpose().lazyProduct(prior);
  products.triangularView<Eigen::StrictlyLower>() = products.transpose();
  return sum;
}

/// Sizes, roundness, exponents, an upright axis, the normals' vote for the centre; a weak hold on
/// the turn about the axis, which a round body leaves open.
void SuperellipsoidCost::evaluate_prior(const FitParameters& p, double* r, double* jacobian) const {
  const ShapePrior& o = prior_;
  Eigen::Map<Eigen::Matrix<double, kPriorResiduals, 1>> residual(r);
  const Vec3 axis = (exp_of(p.tail<3>()) * reference_).col(2);
  residual << (0.5 * (p[0] + p[1]) - o.radius_m) / o.radius_sd_m,
      (p[0] - p[1]) / o.out_of_round_sd_m, (p[2] - o.half_length_m) / o.half_length_sd_m,
      (p[3] - o.e1) / o.exponent_sd, (p[4] - o.e2) / o.exponent_sd,
      (p[5] - centre_vote_.x()) / o.normal_centre_sd_m,
      (p[6] - centre_vote_.y()) / o.normal_centre_sd_m,
      (p[7] - centre_vote_.z()) / o.normal_centre_sd_m, axis.x() / o.tilt_sd_rad,
      axis.y() / o.tilt_sd_rad, p[10];
  if (jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, kPriorResiduals, kFitParameters, Eigen::RowMajor>> j(jacobian);
  j.setZero();
  j(0, 0) = j(0, 1) = 0.5 / o.radius_sd_m;
  j(1, 0) = 1.0 / o.out_of_round_sd_m;
  j(1, 1) = -j(1, 0);
  j(2, 2) = 1.0 / o.half_length_sd_m;
  j(3, 3) = j(4, 4) = 1.0 / o.exponent_sd;
  for (int k = 0; k < 3; ++k) j(5 + k, 5 + k) = 1.0 / o.normal_centre_sd_m;
  // d(R z) = (J dw) × R z = −[R z] J dw.
  const Matrix3d by_turn = -skew(axis) * left_jacobian(p.tail<3>());
  j.block<2, 3>(8, 8) = by_turn.topRows<2>() / o.tilt_sd_rad;
  j(10, 10) = 1.0;
}

}  // namespace canopeer
