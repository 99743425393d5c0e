#pragma once

#include <span>
#include <utility>
#include <vector>

namespace canopeer {

/// max c·x with A x ≤ b, lower ≤ x ≤ upper. All bounds of x are finite, so any y ≥ 0 proves an
/// upper bound, whoever found it: b·y + Σ_j max over x_j of (c_j − A_jᵀ y) x_j (Neumaier &
/// Shcherbina, "Safe bounds in linear and mixed-integer linear programming", Math. Programming
/// 2004). So no tolerance of a solver gets into a bound.
class LinearProgram {
 public:
  using Entry = std::pair<int, double>;  ///< row or column, coefficient

  /// Σ of nothing ≤ rhs so far. Its index.
  int add_row(double rhs);
  /// Finite bounds, lower ≤ upper; entries by row, each row once. Its index.
  int add_column(double objective, double lower, double upper, std::span<const Entry> entries);
  void set_rhs(int row, double rhs) { rhs_[static_cast<std::size_t>(row)] = rhs; }

  [[nodiscard]] int rows() const { return static_cast<int>(rhs_.size()); }
  [[nodiscard]] int columns() const { return static_cast<int>(objective_.size()); }

  /// The bound that `y` (one a row) proves; negative entries count as 0.
  [[nodiscard]] double bound_of(std::span<const double> y) const;
  /// Good y by the simplex method (CLP), one thread, so many iterations at most.
  [[nodiscard]] std::vector<double> duals(int iterations) const;
  /// bound_of(duals()).
  [[nodiscard]] double bound(int iterations) const { return bound_of(duals(iterations)); }

 private:
  std::vector<double> rhs_, objective_, lower_, upper_;
  std::vector<int> starts_ = {0};
  std::vector<int> index_;
  std::vector<double> value_;
};

}  // namespace canopeer
