#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "canopeer/campaign/run_figures.h"
#include "canopeer/record/yardstick.h"

namespace canopeer::app {

/// Where the best known results lie: records/ of the shipped data.
[[nodiscard]] std::filesystem::path records_folder();

/// Where a run's record lies below records/, and what is known of its world before anybody was
/// there.
struct RecordPlace {
  std::filesystem::path file;
  std::optional<Yardstick> fresh;  ///< nothing: only what has a record already is compared
};
/// Nothing: there are no records of such runs.
using RecordOf = std::function<std::optional<RecordPlace>(const RunFigures&)>;

/// Runs that beat the best known are said, and kept in OUT/records in the layout of records/.
void keep_improvements(const std::filesystem::path& out, const std::vector<RunFigures>& runs,
                       const RecordOf& record_of, bool quiet);

/// Of a mission's runs under a protocol.
[[nodiscard]] std::optional<RecordPlace> mission_record_of(const RunFigures& run);

}  // namespace canopeer::app
