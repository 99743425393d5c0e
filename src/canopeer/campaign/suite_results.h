#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/campaign/suite_score.h"

namespace canopeer {

/// What is handed in: every run of some planners on the worlds of a split.
struct SuiteResults {
  std::string canopeer_version;
  std::string suite_version;
  std::string suite_sha256;
  std::string split;
  std::vector<std::string> settings;  ///< overridden in all runs; entries have none
  std::vector<SuiteRun> runs;
  std::vector<SuiteReference> references;  ///< what the numbers are normalised by
  std::vector<SuiteScore> scores;
};

/// Indented JSON; docs/formats.md has its keys. The same results give the same bytes.
[[nodiscard]] std::string suite_results_json(const SuiteResults& results);
/// Takes any text; the error says which key is wrong.
[[nodiscard]] Expected<SuiteResults> parse_suite_results(std::string_view json);
/// One row a run.
[[nodiscard]] std::string suite_results_csv(const SuiteResults& results);

/// What is wrong with an entry, one sentence each; empty: nothing. It is held against the suite:
/// the same frozen worlds, every world of the split with the same seeds for each planner and
/// protocol, no settings and compute tables of one's own, figures that are possible, scores that
/// follow from the runs.
[[nodiscard]] std::vector<std::string> faults_of(const SuiteResults& results, const Suite& suite);

}  // namespace canopeer
