#pragma once

#include <string>
#include <vector>

#include "canopeer/eval/metrics.h"
#include "canopeer/report/fruits/fruit_map_svg.h"
#include "canopeer/report/fruits/fruit_verdicts.h"
#include "canopeer/report/run_files.h"

namespace canopeer {

/// A run directory and what follows from it; what every section of the page draws on.
struct ReportData {
  RunFiles files;
  std::vector<FruitVerdict> verdicts;  ///< one per reported fruit
  std::vector<FoundAtTime> found;      ///< one per frame; empty without ground truth
};

[[nodiscard]] FruitMapInput fruit_map_input(const RunFiles& files);

/// The sections of the page in its order; each is a piece of HTML, empty when there is nothing to
/// show.
[[nodiscard]] std::string headline_section(const ReportData& data);
[[nodiscard]] std::string progress_section(const ReportData& data);
[[nodiscard]] std::string map_section(const ReportData& data);
[[nodiscard]] std::string gallery_section(const ReportData& data);
[[nodiscard]] std::string view_interval_section(const ReportData& data);
[[nodiscard]] std::string frames_section(const ReportData& data);
[[nodiscard]] std::string time_use_section(const ReportData& data);
[[nodiscard]] std::string picture_section(const ReportData& data);
[[nodiscard]] std::string segment_section(const ReportData& data);
[[nodiscard]] std::string figures_section(const ReportData& data);
[[nodiscard]] std::string fruit_list_section(const ReportData& data);
[[nodiscard]] std::string settings_section(const ReportData& data);

}  // namespace canopeer
