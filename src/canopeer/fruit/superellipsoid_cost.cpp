#include "canopeer/fruit/superellipsoid_cost.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

constexpr double kCauchySds = 3.0;  // residuals beyond so many standard deviations count little
constexpr double kTinyM = 1e-7;     // keeps logarithms finite on the body's planes of symmetry
constexpr int kChunk = 32;          // points at a time: all their intermediate values fit the cache

using Chunk = Eigen::Array<double, kChunk, 1>;
/// Of a chunk's points the derivatives, one column each parameter, the residuals and the radial
/// distances, m.
using Rows = Eigen::Matrix<double, kChunk, kFitParameters + 2>;
constexpr int kResidual = kFitParameters;
constexpr int kDistance = kFitParameters + 1;
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kFitParameters, Eigen::RowMajor>;
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
                                       const Matrix3d& reference)
    : x_(static_cast<Eigen::Index>(surface.size())),
      y_(x_.size()),
      z_(x_.size()),
      prior_(prior),
      centre_vote_(centre_vote),
      reference_(reference),
      weight_(point_weight(surface.size(), prior)) {
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    x_[k] = surface[i].point.x();
    y_[k] = surface[i].point.y();
    z_[k] = surface[i].point.z();
  }
}

void SuperellipsoidCost::evaluate(const double* parameters, double* r, double* jacobian) const {
  const FitParameters p = Eigen::Map<const FitParameters>(parameters);
  const Eigen::Index all = x_.size();
  if (jacobian == nullptr) {
    for_each_chunk<false>(p, [&](Eigen::Index from, Eigen::Index n, const Rows& rows) {
      Eigen::Map<Eigen::VectorXd>(r + from, n) = rows.col(kResidual).head(n);
    });
    evaluate_prior(p, r + all, nullptr);
    return;
  }
  for_each_chunk<true>(p, [&](Eigen::Index from, Eigen::Index n, const Rows& rows) {
    Eigen::Map<Eigen::VectorXd>(r + from, n) = rows.col(kResidual).head(n);
    Eigen::Map<Jacobian>(jacobian + from * kFitParameters, n, kFitParameters) =
        rows.topLeftCorner(n, kFitParameters);
  });
  evaluate_prior(p, r + all, jacobian + all * kFitParameters);
}

NormalEquations SuperellipsoidCost::normal_equations(const FitParameters& p) const {
  NormalEquations sum;
  auto& products = sum.products;
  products.setZero();
  for_each_chunk<true>(p, [&](Eigen::Index, Eigen::Index n, Rows& rows) {
    if (n < kChunk) rows.bottomRows(kChunk - n).setZero();
    for (int i = 0; i <= kResidual; ++i) {
      for (int k = 0; k <= i; ++k) products(k, i) += rows.col(k).dot(rows.col(i));
    }
    sum.distances_m2 += rows.col(kDistance).cwiseAbs().cwiseMin(kClippedDistanceM).squaredNorm();
  });
  Eigen::Matrix<double, kPriorResiduals, 1> r;
  Eigen::Matrix<double, kPriorResiduals, kFitParameters, Eigen::RowMajor> j;
  evaluate_prior(p, r.data(), j.data());
  Eigen::Matrix<double, kPriorResiduals, kFitParameters + 1> prior;
  prior << j, r;
  products.noalias() += prior.transpose().lazyProduct(prior);
  products.triangularView<Eigen::StrictlyLower>() = products.transpose();
  return sum;
}

/// The radial distance d = m (1 − 1/G), m the distance from the centre, G = F^(e1/2) the gauge, and
/// by the chain rule through log G: each of its derivatives is a share of the terms of F. Points
/// are taken in chunks, so that logarithms and exponentials run over arrays.
template <bool kDerivatives, typename Take>
void SuperellipsoidCost::for_each_chunk(const FitParameters& p, const Take& take) const {
  const double e1 = p[3];
  const double e2 = p[4];
  const Matrix3d rotation = exp_of(p.tail<3>()) * reference_;
  const Matrix3d to_body = rotation.transpose();
  const Matrix3d turn = left_jacobian(p.tail<3>()).transpose() * rotation;
  const double per_sd = 1.0 / prior_.surface_sd_m;
  const Eigen::Index count = x_.size();
  for (Eigen::Index from = 0; from < count; from += kChunk) {
    const Eigen::Index n = std::min<Eigen::Index>(kChunk, count - from);
    Chunk wx = Chunk::Constant(p[5] + 0.01);
    Chunk wy = Chunk::Constant(p[6] + 0.01);
    Chunk wz = Chunk::Constant(p[7] + 0.01);
    wx.head(n) = x_.segment(from, n);
    wy.head(n) = y_.segment(from, n);
    wz.head(n) = z_.segment(from, n);
    wx -= p[5];
    wy -= p[6];
    wz -= p[7];
    const auto axis = [&](int row) -> Chunk {
      return to_body(row, 0) * wx + to_body(row, 1) * wy + to_body(row, 2) * wz;
    };
    const Chunk qx = axis(0);
    const Chunk qy = axis(1);
    const Chunk qz = axis(2);
    const Chunk m = (qx.square() + qy.square() + qz.square() + kTinyM * kTinyM).sqrt();
    const Chunk log_x = (qx.abs().max(kTinyM) / p[0]).log();
    const Chunk log_y = (qy.abs().max(kTinyM) / p[1]).log();
    const Chunk log_z = (qz.abs().max(kTinyM) / p[2]).log();
    const Chunk power_x = (2.0 / e2 * log_x).exp();
    const Chunk power_y = (2.0 / e2 * log_y).exp();
    const Chunk across = power_x + power_y;
    const Chunk log_across = across.log();
    const Chunk u_term = (e2 / e1 * log_across).exp();
    const Chunk w_term = (2.0 / e1 * log_z).exp();
    const Chunk f = u_term + w_term;
    const Chunk log_f = f.log();
    const Chunk inverse_gauge = (-0.5 * e1 * log_f).exp();
    // The Cauchy loss as a residual: ½ r² = ½ c² log(1 + (d/sd)²/c²) (Triggs et al. 2000).
    const Chunk distance = m * (1.0 - inverse_gauge);
    const Chunk s = distance * per_sd;
    const Chunk t = (s / kCauchySds).square();
    const Chunk small = t - 0.5 * t.square() + t * t.square() / 3.0;
    const Chunk log_1_plus_t = (1.0 + t).log();  // by itself: within a selection it is no vector
    const Chunk log_1_t = (t < 1e-4).select(small, log_1_plus_t);
    const Chunk size = (kCauchySds * kCauchySds * log_1_t).sqrt();
    const Chunk robust = (s < 0.0).select(-size, size);
    Rows rows;
    auto j = rows.array();
    j.col(kResidual) = weight_ * robust;
    j.col(kDistance) = distance;
    if constexpr (!kDerivatives) {
      take(from, n, rows);
      continue;
    }

    // dr/ds = s / (r (1 + t)), 1 at 0.
    const Chunk slope = weight_ * per_sd * (size < 1e-9).select(1.0, s / ((1.0 + t) * robust));
    const Chunk share_u = u_term / f;
    const Chunk share_w = w_term / f;
    const Chunk share_x = share_u * power_x / across;
    const Chunk share_y = share_u * power_y / across;
    const Chunk by_log_gauge = slope * m * inverse_gauge;
    j.col(0) = by_log_gauge * share_x / -p[0];
    j.col(1) = by_log_gauge * share_y / -p[1];
    j.col(2) = by_log_gauge * share_w / -p[2];
    j.col(3) = by_log_gauge *
               (0.5 * log_f - (share_u * e2 * log_across + 2.0 * share_w * log_z) / (2.0 * e1));
    j.col(4) = by_log_gauge * 0.5 *
               (share_u * log_across - 2.0 / e2 * (share_x * log_x + share_y * log_y));
    // Gradient by the point in the body's frame.
    const Chunk along = slope * (1.0 - inverse_gauge) / m;
    const auto away = [](const Chunk& q) -> Chunk {
      return (q < 0.0).select(q.min(-kTinyM), q.max(kTinyM));
    };
    const Chunk gx = along * qx + by_log_gauge * share_x / away(qx);
    const Chunk gy = along * qy + by_log_gauge * share_y / away(qy);
    const Chunk gz = along * qz + by_log_gauge * share_w / away(qz);
    const Chunk cx = gy * qz - gz * qy;
    const Chunk cy = gz * qx - gx * qz;
    const Chunk cz = gx * qy - gy * qx;
    for (int k = 0; k < 3; ++k) {
      j.col(5 + k) = -(rotation(k, 0) * gx + rotation(k, 1) * gy + rotation(k, 2) * gz);
      j.col(8 + k) = turn(k, 0) * cx + turn(k, 1) * cy + turn(k, 2) * cz;
    }
    take(from, n, rows);
  }
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
