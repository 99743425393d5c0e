#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/planner/gomvp/integer_program.h"

namespace canopeer {

/// Where the search for a solution ends. Counts, so that it ends alike everywhere.
struct SolverLimits {
  int max_nodes = 20;         ///< of the tree; 0: its root
  int max_iterations = 4000;  ///< of the simplex, looked at between nodes
};

struct SolverAnswer {
  std::optional<std::vector<double>> better;  ///< than the known solution; nothing: none found
  bool optimal = false;                       ///< proven: of `better`, or of the known one
  std::int64_t iterations = 0;                ///< of the simplex
  std::int64_t rows = 0;                      ///< of the program
};

/// Branch and cut by CBC (COIN-OR, Forrest & Lougee-Heimer) from a known solution on. One thread, a
/// fixed seed, no clock: the same answer every time with the same CBC. Prints nothing. `known`: a
/// solution.
[[nodiscard]] SolverAnswer solve(const IntegerProgram& program, const std::vector<double>& known,
                                 const SolverLimits& limits);

}  // namespace canopeer
