#pragma once

#include "canopeer/run/run_registries.h"

namespace canopeer {

/// The program `canopeer` with what is registered: your own planners, detectors and sites can be
/// named in missions and on the command line of a program of your own, as those of the library.
///
///     int main(int argc, char** argv) {
///       auto registries = canopeer::RunRegistries::built_in();
///       if (!registries.planners.add("mine", "My own planner", make_mine)) return 2;
///       return canopeer::run_program(argc, argv, registries);
///     }
///
/// Returns the exit status: 0 done, 1 the run failed, 2 bad usage or input, 130 interrupted.
/// `bench` starts the same program for each run.
int run_program(int argc, char** argv, const RunRegistries& registries);

}  // namespace canopeer
