#pragma once

#include <filesystem>

#include "canopeer/mission/mission.h"
#include "canopeer/record/summary.h"
#include "canopeer/scene/scene.h"

namespace canopeer::app {

/// Writes everything a run leaves in `out` beside its record: fruits.csv, fruits.ply, map.ot,
/// map_roi.ot, timeline.csv, ground_truth.csv, pictures, summary.json, report.html. Each file is
/// written whole or not at all.
[[nodiscard]] Expected<Summary> write_results(const std::filesystem::path& out,
                                              const RunHeader& header, const Mission& mission,
                                              const Scene& scene, double wall_time_s);

/// The figures people ask for first, on standard output.
void print_summary(const Summary& summary, const std::filesystem::path& out);

}  // namespace canopeer::app
