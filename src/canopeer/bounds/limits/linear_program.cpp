#include "canopeer/bounds/limits/linear_program.h"

#include <coin/Clp_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "canopeer/base/check.h"

namespace canopeer {

int LinearProgram::add_row(double rhs) {
  rhs_.push_back(rhs);
  return rows() - 1;
}

int LinearProgram::add_column(double objective, double lower, double upper,
                              std::span<const Entry> entries) {
  CANOPEER_CHECK(std::isfinite(lower) && std::isfinite(upper) && lower <= upper, "finite bounds");
  objective_.push_back(objective);
  lower_.push_back(lower);
  upper_.push_back(upper);
  for (const auto& [row, value] : entries) {
    index_.push_back(row);
    value_.push_back(value);
  }
  starts_.push_back(static_cast<int>(index_.size()));
  return columns() - 1;
}

double LinearProgram::bound_of(std::span<const double> y) const {
  CANOPEER_CHECK(y.size() == rhs_.size(), "one a row");
  const auto at = [&](std::size_t row) { return y[row] > 0.0 ? y[row] : 0.0; };
  double bound = 0.0;
  for (std::size_t i = 0; i < rhs_.size(); ++i) bound += rhs_[i] * at(i);
  for (std::size_t j = 0; j < objective_.size(); ++j) {
    double reduced = objective_[j];
    for (auto k = static_cast<std::size_t>(starts_[j]);
         k < static_cast<std::size_t>(starts_[j + 1]); ++k) {
      reduced -= value_[k] * at(static_cast<std::size_t>(index_[k]));
    }
    bound += std::max(reduced * lower_[j], reduced * upper_[j]);
  }
  return bound;
}

std::vector<double> LinearProgram::duals(int iterations) const {
  std::vector<double> y(rhs_.size(), 0.0);
  if (rhs_.empty() || objective_.empty()) return y;
  const std::unique_ptr<Clp_Simplex, decltype(&Clp_deleteModel)> model(Clp_newModel(),
                                                                       &Clp_deleteModel);
  Clp_setLogLevel(model.get(), 0);
  std::vector<double> least(objective_.size());  // CLP finds minima
  std::transform(objective_.begin(), objective_.end(), least.begin(), [](double c) { return -c; });
  Clp_loadProblem(model.get(), columns(), rows(), starts_.data(), index_.data(), value_.data(),
                  lower_.data(), upper_.data(), least.data(), nullptr, rhs_.data());
  Clp_setMaximumIterations(model.get(), iterations);
  Clp_dual(model.get(), 0);
  const double* price = Clp_dualRowSolution(model.get());
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = std::isfinite(price[i]) ? std::max(0.0, -price[i]) : 0.0;
  }
  return y;
}

}  // namespace canopeer
