#include "canopeer/eval/assignment.h"

#include <limits>

#include "canopeer/base/check.h"

namespace canopeer {

std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost) {
  const int rows = static_cast<int>(cost.rows());
  const int columns = static_cast<int>(cost.cols());
  CANOPEER_CHECK(rows <= columns, "every row needs a column");
  Eigen::VectorXd row_potential = Eigen::VectorXd::Zero(rows + 1);
  Eigen::VectorXd column_potential = Eigen::VectorXd::Zero(columns + 1);
  std::vector<int> row_of(columns + 1, 0);  // 1-based; column 0 holds the row being placed
  std::vector<int> came_from(columns + 1, 0);
  for (int row = 1; row <= rows; ++row) {
    row_of[0] = row;
    int column = 0;
    Eigen::VectorXd slack =
        Eigen::VectorXd::Constant(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<char> reached(columns + 1, 0);
    do {
      reached[column] = 1;
      const int r = row_of[column];
      int next = 0;
      double step = std::numeric_limits<double>::infinity();
      for (int c = 1; c <= columns; ++c) {
        if (reached[c] != 0) continue;
        const double reduced = cost(r - 1, c - 1) - row_potential[r] - column_potential[c];
        if (reduced < slack[c]) {
          slack[c] = reduced;
          came_from[c] = column;
        }
        if (slack[c] < step) {
          step = slack[c];
          next = c;
        }
      }
      for (int c = 0; c <= columns; ++c) {
        if (reached[c] != 0) {
          row_potential[row_of[c]] += step;
          column_potential[c] -= step;
        } else {
          slack[c] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    while (column != 0) {
      row_of[column] = row_of[came_from[column]];
      column = came_from[column];
    }
  }
  std::vector<int> column_of(rows, -1);
  for (int c = 1; c <= columns; ++c) {
    if (row_of[c] != 0) column_of[row_of[c] - 1] = c - 1;
  }
  return column_of;
}

}  // namespace canopeer
