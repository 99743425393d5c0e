#include "canopeer/planner/gomvp/cbc_solver.h"

#include <CbcHeuristic.hpp>
#include <CbcModel.hpp>
#include <CglFlowCover.hpp>
#include <CglGomory.hpp>
#include <CglMixedIntegerRounding2.hpp>
#include <CglZeroHalf.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <numeric>

namespace canopeer {
namespace {

constexpr int kSeed = 1;
constexpr double kBetterBy = 1e-6;

void load_program(const IntegerProgram& program, OsiClpSolverInterface& solver) {
  solver.messageHandler()->setLogLevel(0);
  solver.setHintParam(OsiDoReducePrint, true, OsiHintTry);
  solver.getModelPtr()->setLogLevel(0);
  solver.getModelPtr()->setRandomSeed(kSeed);
  const CoinPackedMatrix matrix(false, program.column_count(), program.row_count(),
                                static_cast<CoinBigIndex>(program.values.size()),
                                program.values.data(), program.columns.data(),
                                program.starts.data(), nullptr);
  solver.loadProblem(matrix, program.lower.data(), program.upper.data(), program.cost.data(),
                     program.row_lower.data(), program.row_upper.data());
  solver.setInteger(program.integers.data(), static_cast<int>(program.integers.size()));
}

double cost_of(const IntegerProgram& program, const double* values) {
  return std::inner_product(program.cost.begin(), program.cost.end(), values, 0.0);
}

}  // namespace

SolverAnswer solve(const IntegerProgram& program, const std::vector<double>& known,
                   const SolverLimits& limits) {
  SolverAnswer answer;
  answer.rows = program.row_count();
  try {
    OsiClpSolverInterface solver;
    load_program(program, solver);
    CbcModel model(solver);
    model.setLogLevel(0);
    model.messageHandler()->setLogLevel(0);
    model.setRandomSeed(kSeed);
    model.setMaximumNodes(limits.max_nodes);
    model.setMaximumNumberIterations(limits.max_iterations);
    // Cuts that programs with covers and flows have use for, at the root.
    CglMixedIntegerRounding2 rounding;
    CglFlowCover flow_cover;
    CglZeroHalf zero_half;
    CglGomory gomory;
    gomory.setLimit(100);
    model.addCutGenerator(&rounding, -99, "rounding");
    model.addCutGenerator(&flow_cover, -99, "flow cover");
    model.addCutGenerator(&zero_half, -99, "zero half");
    model.addCutGenerator(&gomory, -99, "gomory");
    CbcRounding near(model);
    model.addHeuristic(&near);
    model.setMaximumCutPassesAtRoot(3);
    model.setNumberStrong(0);
    const double known_cost = cost_of(program, known.data());
    model.setBestSolution(known.data(), program.column_count(), known_cost);
    model.branchAndBound(0);
    answer.iterations = std::max(1, model.getIterationCount() + model.numberStrongIterations());
    answer.optimal = model.isProvenOptimal();
    const double* best = model.bestSolution();
    if (best != nullptr && cost_of(program, best) < known_cost - kBetterBy)
      answer.better = std::vector<double>(best, best + program.column_count());
  } catch (const CoinError&) {
    answer.better.reset();  // numerical trouble of the solver's: the known solution stands
    answer.optimal = false;
  }
  return answer;
}

}  // namespace canopeer
