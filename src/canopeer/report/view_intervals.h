#pragma once

#include <vector>

#include "canopeer/record/run_record.h"

namespace canopeer {

/// Times between two views that follow each other in the same segment, s, by segment as in
/// `record.segments`.
[[nodiscard]] std::vector<std::vector<double>> view_intervals(const RunRecord& record);

}  // namespace canopeer
