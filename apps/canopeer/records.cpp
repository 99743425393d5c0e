#include "records.h"

#include <cstdio>
#include <map>

#include "canopeer/campaign/best_known.h"
#include "exit_status.h"
#include "shipped_data.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

void say(const fs::path& file, const Yardstick& better, bool is_new) {
  const auto& most = better.best_found;
  const auto& soonest = better.best_auc;
  std::printf("%s %s, %s: %d of %d fruits by %s, AUC %.4f by %s; kept in %s\n",
              is_new ? "the first result on" : "a new best on", better.mission.c_str(),
              better.protocol.c_str(), most ? most->detected : 0, better.fruits_total,
              most ? most->planner.c_str() : "nobody", soonest ? soonest->auc : 0.0,
              soonest ? soonest->planner.c_str() : "nobody", file.c_str());
}

}  // namespace

fs::path records_folder() { return shipped_data() / "records"; }

void keep_improvements(const fs::path& out, const std::vector<RunFigures>& runs,
                       const RecordOf& record_of, bool quiet) {
  struct Record {
    std::optional<Yardstick> now;
    bool is_new = false;
    bool better = false;
  };
  std::map<fs::path, Record> records;
  for (const RunFigures& run : runs) {
    const auto place = record_of(run);
    if (!place) continue;
    auto [known, first] = records.try_emplace(place->file);
    Record& record = known->second;
    if (first) {
      record.now = value_or_stop(known_yardstick(records_folder() / place->file), kFailed);
      record.is_new = !record.now.has_value();
      if (record.is_new) record.now = place->fresh;
    }
    if (!record.now) continue;
    if (auto improved = improved_by(*record.now, run, CANOPEER_VERSION)) {
      record.now = std::move(improved);
      record.better = true;
    }
  }
  for (const auto& [file, record] : records) {
    if (!record.better) continue;
    const fs::path path = out / "records" / file;
    std::error_code code;
    fs::create_directories(path.parent_path(), code);
    value_or_stop(write_yardstick(path, *record.now), kFailed);
    if (!quiet) say(path, *record.now, record.is_new);
  }
}

std::optional<RecordPlace> mission_record_of(const RunFigures& run) {
  if (run.job.protocol.empty() || !run.job.contestant.table.empty()) return std::nullopt;
  return RecordPlace{mission_record(run.job.mission_name, run.job.seed, run.job.protocol),
                     std::nullopt};
}

}  // namespace canopeer::app
