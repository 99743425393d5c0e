#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"

namespace canopeer {

/// Makes `run_dir/report.html` (one file with everything in it: no script, no network) and
/// `run_dir/fruit_map.svg` from what a run left in `run_dir`, and from nothing else:
/// `record` must be there; `summary.json`, `fruits.csv`, `ground_truth.csv` and `pictures/*.png`
/// are used when they are. An interrupted or killed run and a run without fruits get their page
/// too. The same directory gives the same bytes.
[[nodiscard]] Expected<void> write_report(const std::filesystem::path& run_dir);

}  // namespace canopeer
