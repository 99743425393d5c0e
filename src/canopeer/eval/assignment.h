#pragma once

#include <Eigen/Core>
#include <vector>

namespace canopeer {

/// The column of each row in the one-to-one assignment with the smallest total cost; `cost` is
/// rows × columns, rows ≤ columns, finite (Kuhn 1955, in the O(rows² · columns) form with
/// potentials). Deterministic.
[[nodiscard]] std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost);

}  // namespace canopeer
