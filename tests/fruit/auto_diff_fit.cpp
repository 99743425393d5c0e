#include "auto_diff_fit.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/rotation.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace canopeer::testing_support {
namespace {

constexpr double kCauchySds = 3.0;

/// R = exp([w]) R0, column-major.
template <typename T>
Eigen::Matrix<T, 3, 3> rotation_of_parameters(const T* p, const Eigen::Matrix3d& reference) {
  Eigen::Matrix<T, 3, 3> turn;
  ceres::AngleAxisToRotationMatrix(p + 8, turn.data());
  return turn * reference.cast<T>();
}

struct PointCost {
  Vec3 point;
  Eigen::Matrix3d reference;
  double sd_m;

  template <typename T>
  bool operator()(const T* p, T* residual) const {
    using std::abs;
    using std::pow;
    using std::sqrt;
    const Eigen::Matrix<T, 3, 1> d(point.x() - p[5], point.y() - p[6], point.z() - p[7]);
    const Eigen::Matrix<T, 3, 1> q = rotation_of_parameters(p, reference).transpose() * d;
    const auto scaled = [&](int axis) {
      const T s = abs(q[axis]) / p[axis];
      return s < 1e-6 ? T(1e-6) : s;
    };
    const T across = pow(scaled(0), 2.0 / p[4]) + pow(scaled(1), 2.0 / p[4]);
    const T f = pow(across, p[4] / p[3]) + pow(scaled(2), 2.0 / p[3]);
    const T distance = sqrt(q.squaredNorm());
    residual[0] = distance * (1.0 - pow(f, -0.5 * p[3])) / sd_m;
    return true;
  }
};

struct PriorCost {
  ShapePrior prior;
  Vec3 vote;
  Eigen::Matrix3d reference;

  template <typename T>
  bool operator()(const T* p, T* r) const {
    const Eigen::Matrix<T, 3, 1> axis = rotation_of_parameters(p, reference).col(2);
    r[0] = (0.5 * (p[0] + p[1]) - prior.radius_m) / prior.radius_sd_m;
    r[1] = (p[0] - p[1]) / prior.out_of_round_sd_m;
    r[2] = (p[2] - prior.half_length_m) / prior.half_length_sd_m;
    r[3] = (p[3] - prior.e1) / prior.exponent_sd;
    r[4] = (p[4] - prior.e2) / prior.exponent_sd;
    for (int k = 0; k < 3; ++k) r[5 + k] = (p[5 + k] - vote[k]) / prior.normal_centre_sd_m;
    r[8] = axis.x() / prior.tilt_sd_rad;
    r[9] = axis.y() / prior.tilt_sd_rad;
    r[10] = p[10];
    return true;
  }
};

struct Solution {
  FitParameters parameters;
  double cost = std::numeric_limits<double>::infinity();
};

Solution solve(std::span<const SurfacePoint> surface, const FitOptions& options, const Vec3& vote,
               const FitParameters& start, const Eigen::Matrix3d& reference, int iterations) {
  Solution solution{start};
  double* const p = solution.parameters.data();
  ceres::Problem problem;
  const double share = std::min(1.0, options.prior.effective_points / double(surface.size()));
  for (const SurfacePoint& s : surface) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PointCost, 1, kFitParameters>(
            new PointCost{s.point, reference, options.prior.surface_sd_m}),
        new ceres::ScaledLoss(new ceres::CauchyLoss(kCauchySds), share, ceres::TAKE_OWNERSHIP), p);
  }
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorCost, 11, kFitParameters>(
                               new PriorCost{options.prior, vote, reference}),
                           nullptr, p);
  for (int i = 0; i < 5; ++i) {
    problem.SetParameterLowerBound(p, i, i < 3 ? kMinSemiAxisM : kMinExponent);
    problem.SetParameterUpperBound(p, i, i < 3 ? kMaxSemiAxisM : kMaxExponent);
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = iterations;
  solver.max_num_line_search_step_size_iterations = 0;
  solver.function_tolerance = options.function_tolerance;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (summary.IsSolutionUsable()) solution.cost = summary.final_cost;
  return solution;
}

std::vector<SurfacePoint> thinned(std::span<const SurfacePoint> surface, int count) {
  const std::size_t most = static_cast<std::size_t>(count);
  std::vector<SurfacePoint> chosen;
  if (surface.size() <= most) return {surface.begin(), surface.end()};
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(surface[i * surface.size() / most]);
  return chosen;
}

}  // namespace

AutoDiffFit auto_diff_fit(std::span<const SurfacePoint> surface, const FitOptions& options) {
  const std::vector<SurfacePoint> fine = thinned(surface, options.max_points);
  const std::vector<SurfacePoint> coarse = thinned(fine, options.coarse_points);
  const Vec3 vote = centre_by_normals(fine, options.prior);
  Solution best;
  Eigen::Matrix3d reference = Eigen::Matrix3d::Identity();
  for (const Superellipsoid& start : fit_starts(fine, options)) {
    const Eigen::Matrix3d own = start.T_world_body.linear();
    const Solution solution =
        solve(coarse, options, vote, parameters_of(start), own,
              fine.size() > coarse.size() ? options.coarse_iterations : options.max_iterations);
    if (solution.cost >= best.cost) continue;
    best = solution;
    reference = own;
  }
  if (fine.size() > coarse.size())
    best = solve(fine, options, vote, best.parameters, reference, options.max_iterations);
  return {body_of(best.parameters, reference), best.cost};
}

}  // namespace canopeer::testing_support
