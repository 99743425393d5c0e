#pragma once

#include <string>

#include "canopeer/record/run_record.h"

namespace canopeer {

/// `timeline.csv`: one row per view in the order they were taken. An unknown predicted gain is an
/// empty field. Times in seconds to the millisecond, camera positions in metres (world) to 0.1 mm.
[[nodiscard]] std::string timeline_csv(const RunRecord& record);

}  // namespace canopeer
