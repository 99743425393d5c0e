#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/campaign/comparison.h"

namespace canopeer {

/// Writes into `out`: `comparison.html` (one file, no script, no network), `comparison.md`,
/// `comparison.csv`, `runs.csv` and the plots as `plots/*.svg`. Any number of runs may be missing;
/// the page says how many. The same runs give the same bytes.
[[nodiscard]] Expected<void> write_comparison(const std::filesystem::path& out,
                                              const CampaignPlan& plan,
                                              const std::vector<RunFigures>& runs);

/// What the page shows, as HTML: headline, and every match.
[[nodiscard]] std::string comparison_html(const Comparison& comparison);

}  // namespace canopeer
