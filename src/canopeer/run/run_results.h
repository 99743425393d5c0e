#pragma once

#include <filesystem>
#include <optional>

#include "canopeer/mission/mission.h"
#include "canopeer/record/summary.h"
#include "canopeer/record/yardstick.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sensing/frame_agreement.h"

namespace canopeer {

/// Writes everything a run leaves in `out` beside its record: fruits.csv, .json, .ply and .glb,
/// map.ot, map_roi.ot, timeline.csv, summary.json, report.html. Where the truth is known (`truth`
/// not null) ground_truth.csv and a picture too, and the scores against it; with a `yardstick` (or
/// null) their shares of it. `agreement`: of pose and image; nothing where no frames were taken on
/// the way. Each file is written whole or not at all; the error is that of the first that cannot
/// be.
[[nodiscard]] Expected<Summary> write_results(const std::filesystem::path& out,
                                              const RunRecord& record, const Mission& mission,
                                              const Scene* truth, const Yardstick* yardstick,
                                              const std::optional<FrameAgreement>& agreement,
                                              double wall_time_s);

}  // namespace canopeer
