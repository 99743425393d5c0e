#include "canopeer/fruit/shapes/superellipsoid_fit.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

/// Our cost as Ceres sees one: twelve residuals in place of one for each point and prior. The
/// factor U of [J r]ᵀ[J r] = UᵀU has the same JᵀJ, Jᵀr and rᵀr as the whole [J r], which is all
/// that a step depends on (Golub & Van Loan, Matrix Computations, 5.3: least squares by the normal
/// equations, as DENSE_NORMAL_CHOLESKY solves them anyway). So Ceres handles 12 × 11 numbers, not
/// thousands. It asks for the cost of a step first and for the derivatives there when it takes the
/// step, which it mostly does: both share their logarithms, so both are computed at once and kept.
class CeresCost final : public ceres::CostFunction {
 public:
  static constexpr int kRows = kFitParameters + 1;
  using Square = Eigen::Matrix<double, kRows, kRows>;

  explicit CeresCost(const SuperellipsoidCost& cost) : cost_(cost) {
    set_num_residuals(kRows);
    mutable_parameter_block_sizes()->push_back(kFitParameters);
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const FitParameters p = Eigen::Map<const FitParameters>(parameters[0]);
    factor_at(p);
    Eigen::Map<Eigen::Matrix<double, kRows, 1>> r(residuals);
    r = factor_.col(kFitParameters);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kRows, kFitParameters, Eigen::RowMajor>> j(jacobians[0]);
      j = factor_.leftCols<kFitParameters>();
    }
    return true;
  }

  /// At p, most often known from the last step there.
  [[nodiscard]] const NormalEquations& equations_at(const FitParameters& p) const {
    factor_at(p);
    return equations_;
  }

 private:
  void factor_at(const FitParameters& p) const {
    if (known_ && p == at_) return;
    equations_ = cost_.normal_equations(p);
    factor_ = factor_of(equations_.products);
    at_ = p;
    known_ = true;
  }

  /// Upper triangular; the last pivot, what is left of rᵀr, may be nothing but rounding.
  static Square factor_of(const Square& a) {
    Square u = Square::Zero();
    for (int i = 0; i < kRows; ++i) {
      const double pivot = a(i, i) - u.col(i).head(i).squaredNorm();
      u(i, i) = std::sqrt(std::max(0.0, pivot));
      if (!(u(i, i) > 0.0)) continue;
      for (int k = i + 1; k < kRows; ++k) {
        u(i, k) = (a(i, k) - u.col(i).head(i).dot(u.col(k).head(i))) / u(i, i);
      }
    }
    return u;
  }

  const SuperellipsoidCost& cost_;
  mutable FitParameters at_;
  mutable NormalEquations equations_;  // at at_
  mutable Square factor_;
  mutable bool known_ = false;
};

ceres::Solver::Options solver_options(const FitOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;
  // Steps are clipped to the bounds; a line search along each clipped step costs more than it
  // helps.
  solver.max_num_line_search_step_size_iterations = 0;
  return solver;
}

struct Solution {
  FitParameters parameters;
  NormalEquations equations;  // there
  double cost = std::numeric_limits<double>::infinity();
  bool converged = false;
};

Solution solve(const SuperellipsoidCost& cost, const FitParameters& start,
               const ceres::Solver::Options& options) {
  Solution solution{start, {}};
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  CeresCost function(cost);
  ceres::Problem problem(ownership);
  double* const p = solution.parameters.data();
  problem.AddResidualBlock(&function, nullptr, p);
  for (int i = 0; i < 5; ++i) {
    problem.SetParameterLowerBound(p, i, i < 3 ? kMinSemiAxisM : kMinExponent);
    problem.SetParameterUpperBound(p, i, i < 3 ? kMaxSemiAxisM : kMaxExponent);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  solution.cost = summary.IsSolutionUsable() ? summary.final_cost : solution.cost;
  solution.equations = function.equations_at(solution.parameters);
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  return solution;
}

/// `count` of the points at most, evenly.
std::vector<SurfacePoint> thinned(std::span<const SurfacePoint> surface, int count) {
  const std::size_t most = static_cast<std::size_t>(count);
  std::vector<SurfacePoint> chosen;
  if (surface.size() <= most) return {surface.begin(), surface.end()};
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(surface[i * surface.size() / most]);
  return chosen;
}

/// Of the volume by the parameters; by the exponents as differences.
FitParameters volume_gradient(const Superellipsoid& body) {
  FitParameters gradient = FitParameters::Zero();
  gradient.head<3>() = body.volume_m3() * body.semi_axes_m.cwiseInverse();
  constexpr double kStep = 1e-4;
  for (int k = 0; k < 2; ++k) {
    Superellipsoid low = body;
    Superellipsoid high = body;
    (k == 0 ? low.e1 : low.e2) -= kStep;
    (k == 0 ? high.e1 : high.e2) += kStep;
    gradient[3 + k] = (high.volume_m3() - low.volume_m3()) / (2.0 * kStep);
  }
  return gradient;
}

/// Covariance (JᵀJ)⁻¹: residuals are in standard deviations, the prior is among them.
void set_errors(const NormalEquations& equations, SuperellipsoidFit& fit) {
  const Eigen::Matrix<double, kFitParameters, kFitParameters> h =
      equations.products.topLeftCorner<kFitParameters, kFitParameters>();
  fit.covariance = h.ldlt().solve(decltype(fit.covariance)::Identity().eval());
  fit.centre_sd_m = fit.covariance.diagonal().segment<3>(5).cwiseMax(0.0).cwiseSqrt();
  const FitParameters g = volume_gradient(fit.body);
  fit.volume_sd_cm3 = 1e6 * std::sqrt(std::max(0.0, g.dot(fit.covariance * g)));
}

}  // namespace

SuperellipsoidFit fit_superellipsoid(std::span<const SurfacePoint> surface,
                                     const FitOptions& options,
                                     const std::optional<Superellipsoid>& before) {
  CANOPEER_CHECK(!surface.empty(), "a fit needs points");
  const std::vector<SurfacePoint> fine = thinned(surface, options.max_points);
  const std::vector<SurfacePoint> coarse = thinned(fine, options.coarse_points);
  const Vec3 vote = centre_by_normals(fine, options.prior);
  const std::vector<Superellipsoid> starts =
      before ? std::vector{*before} : fit_starts(fine, options);
  const ceres::Solver::Options solver = solver_options(options);
  ceres::Solver::Options trial = solver;
  if (fine.size() > coarse.size()) trial.max_num_iterations = options.coarse_iterations;
  const Superellipsoid* from = nullptr;
  Solution best;
  if (starts.size() == 1) {
    from = starts.data();
    best.parameters = parameters_of(*from);
  }
  for (const Superellipsoid& start : starts) {
    if (starts.size() == 1) break;
    const SuperellipsoidCost cost(coarse, options.prior, vote, start.T_world_body.linear());
    const Solution solution = solve(cost, parameters_of(start), trial);
    if (from != nullptr && solution.cost >= best.cost) continue;
    best = solution;
    from = &start;
  }
  const SuperellipsoidCost cost(fine, options.prior, vote, from->T_world_body.linear());
  if (fine.size() > coarse.size() || starts.size() == 1)
    best = solve(cost, best.parameters, solver);
  SuperellipsoidFit fit;
  fit.body = body_of(best.parameters, from->T_world_body.linear());
  fit.rms_m = std::sqrt(best.equations.distances_m2 / static_cast<double>(cost.points()));
  fit.cost = best.cost;
  fit.starts = static_cast<int>(starts.size());
  fit.converged = best.converged;
  set_errors(best.equations, fit);
  return fit;
}

}  // namespace canopeer
