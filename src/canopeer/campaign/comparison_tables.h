#pragma once

#include <string>
#include <vector>

#include "canopeer/campaign/comparison.h"

namespace canopeer {

/// `runs.csv`: one row a run, a column a figure; an empty field: not measured.
[[nodiscard]] std::string runs_csv(const std::vector<RunFigures>& runs);

/// `comparison.csv`: one row per mission, budget, planner and figure. Columns: n, mean, standard
/// deviation, 95 % interval; then the paired difference from the first planner, with interval and p
/// values, and the protocol.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

/// `comparison.md`: a table of all figures for each mission and budget, and the paired tests.
[[nodiscard]] std::string comparison_markdown(const Comparison& comparison);

/// "39.2 ± 1.9"; "–" without a value; no ± for one value.
[[nodiscard]] std::string mean_text(const SampleFigures& figures, int decimals);
/// "37.5 … 40.8"; empty below two values.
[[nodiscard]] std::string interval_text(const SampleFigures& figures, int decimals);
/// "0.031", "< 0.001"; "–" without a value.
[[nodiscard]] std::string p_text(const std::optional<double>& p);

}  // namespace canopeer
