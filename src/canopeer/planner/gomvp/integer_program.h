#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/planner/gomvp/inspection_problem.h"

namespace canopeer {

/// min cost · v, row_lower ≤ A v ≤ row_upper, lower ≤ v ≤ upper, some of v whole numbers. A row by
/// row: entries starts[r] … starts[r + 1] − 1.
struct IntegerProgram {
  std::vector<double> cost;
  std::vector<double> lower;
  std::vector<double> upper;
  std::vector<int> integers;  ///< columns
  std::vector<int> starts = {0};
  std::vector<int> columns;
  std::vector<double> values;
  std::vector<double> row_lower;
  std::vector<double> row_upper;

  [[nodiscard]] int column_count() const { return static_cast<int>(cost.size()); }
  [[nodiscard]] int row_count() const { return static_cast<int>(row_lower.size()); }
};

/// The program of an inspection problem on a sparse graph of arcs (GO-VMP, Jose et al. 2025):
///   x_a   arc a is taken          y_i   view i is on the path
///   f_a   goods on arc a          z_j   target j is seen (orienteering)
///   Σ_in(i) x = y_i,  Σ_out(i) x ≤ y_i,  Σ_out(s) x ≤ 1          a path, its end anywhere
///   Σ_in(i) f − Σ_out(i) f = y_i,  x_a ≤ f_a ≤ M x_a             no cycle: each view takes one
///   cover:          min Σ c x,            Σ_{i ∈ S_j} y_i ≥ 1
///   orienteering:   max Σ w z − p Σ c x,  z_j ≤ Σ_{i ∈ S_j} y_i,  Σ c x ≤ T
/// M is the most views a best path has: each sees a target that no other one does.
class InspectionProgram {
 public:
  /// Arcs from the start to all views, from each view to its `neighbors` nearest, and those of
  /// `known`, a valid path; so the program has a solution.
  InspectionProgram(const InspectionProblem& problem, int neighbors, const InspectionPath& known);

  [[nodiscard]] const IntegerProgram& program() const { return program_; }
  /// The values that stand for `path`, whose arcs are all there.
  [[nodiscard]] std::vector<double> values_of(const InspectionPath& path) const;
  /// The path that `values`, a solution, stand for.
  [[nodiscard]] InspectionPath path_of(const std::vector<double>& values) const;

 private:
  struct Arc {
    int from = 0;  ///< kStart or a view
    int to = 0;
    double time_s = 0.0;
  };
  struct Row {
    std::vector<int> columns{};
    std::vector<double> values{};
    void put(int column, double value) {
      columns.push_back(column);
      values.push_back(value);
    }
  };
  static constexpr int kStart = -1;

  void choose_arcs(int neighbors, const InspectionPath& known);
  int add_column(double cost, double upper, bool integer);
  void add_row(const Row& row, double lower, double upper);
  void add_columns();
  void add_path_rows();
  void add_flow_rows();
  void add_target_rows();
  [[nodiscard]] int y(int view) const { return view; }
  [[nodiscard]] int x(std::size_t arc) const { return problem_.views() + static_cast<int>(arc); }
  [[nodiscard]] int f(std::size_t arc) const { return x(arc) + static_cast<int>(arcs_.size()); }
  [[nodiscard]] int z(int target) const { return f(arcs_.size()) + target; }
  [[nodiscard]] double most_views() const;

  InspectionProblem problem_;
  std::vector<Arc> arcs_;
  IntegerProgram program_;
};

}  // namespace canopeer
