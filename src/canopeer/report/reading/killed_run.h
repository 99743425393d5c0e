#pragma once

#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/record/run_record.h"
#include "canopeer/record/summary.h"

namespace canopeer {

/// What the record alone tells of a run that was killed before it could write its summary. Whatever
/// needs ground truth is null, the wall time 0: unknown.
[[nodiscard]] Summary summary_from_record(const RunRecord& record);

/// The fruits known after the last view, as balls of their volume: a record holds no shapes.
[[nodiscard]] std::vector<FruitEstimate> fruits_from_record(const RunRecord& record);

}  // namespace canopeer
