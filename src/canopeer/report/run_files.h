#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/record/run_record.h"
#include "canopeer/record/summary.h"
#include "canopeer/scene/fruit_truth.h"
#include "canopeer/sensing/cloud_file.h"

namespace canopeer {

/// A picture of a run, for its report.
struct ReportPicture {
  std::string caption;    ///< from the file's name: "02_row_after.png" → "Row after"
  std::string png_bytes;  ///< the file
};

/// What a run directory holds, as far as a report needs it.
struct RunFiles {
  Summary summary;
  RunRecord record;
  std::vector<FruitEstimate> fruits;
  CloudFile surface;                    ///< of the fruits, each point with its fruit; may be empty
  std::vector<FruitTruth> truth;        ///< empty: no ground_truth.csv
  std::vector<ReportPicture> pictures;  ///< by file name
  bool replay = false;                  ///< `canopeer view` can show the run again
};

/// `record` must be there; a run killed before it wrote `summary.json` and `fruits.csv` is read
/// from its record alone. The error names the file (and line) at fault.
[[nodiscard]] Expected<RunFiles> read_run_files(const std::filesystem::path& run_dir);

}  // namespace canopeer
