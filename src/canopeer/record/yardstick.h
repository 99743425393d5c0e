#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// So many fruits at most (a bound), or at least (a result), by mission time t.
struct FruitsByTime {
  double t_s = 0.0;
  double fruits = 0.0;
};

/// What no planner can surpass: of fruits found (optimal pairs, 0.05 m) at the end, of the mean of
/// found / fruits_total over the mission time, and of fruits at any time.
struct UpperBound {
  std::optional<double> fruits;
  std::optional<double> auc;
  std::vector<FruitsByTime> course;  ///< by time; empty: not reckoned
  std::string by;                    ///< which of the bounds is the least at the end
};

/// What a plan or a planner has reached in the simulator.
struct BestResult {
  int detected = 0;
  double auc = 0.0;
  std::string planner;     ///< or "clairvoyant"
  std::string version;     ///< of Canopeer
  std::uint64_t seed = 1;  ///< of the run; the world has its own in Yardstick
  std::string plan;        ///< file beside the yardstick's, of the planner `playback`; empty: none
  /// Settings that differ from the mission's, "key=value".
  std::vector<std::string> settings;
};

/// How good results on one world under one protocol could be: what runs are held against
/// (docs/benchmark.md). Written by `canopeer bound`, kept in records/. A part nobody has reckoned
/// is null.
struct Yardstick {
  std::string mission;   ///< name
  std::string protocol;  ///< name of the rules; "own": the mission's own settings
  std::uint64_t world_seed = 1;
  std::string world_hash;  ///< of what the runs depend on besides seed and planner
  int fruits_total = 0;    ///< counted ones

  // What any reachable view can show: the visibility ceiling.
  std::optional<int> ceiling_fruits;
  std::optional<double> ceiling_surface;  ///< share of the counted fruits' surface, 0 … 1
  std::int64_t ceiling_views = 0;         ///< sampled for it
  double ceiling_seen_once = 0.0;         ///< share of the patches seen by one of them only
  // Fewest views (greedy) that show so much of what can be seen.
  std::optional<int> cover_views_90;
  std::optional<int> cover_views_100;

  std::optional<BestResult> clairvoyant;  ///< knows the scene, executed in the simulator
  std::optional<BestResult> best_found;   ///< most fruits of all known, then AUC
  std::optional<BestResult> best_auc;
  std::optional<UpperBound> sampled;    ///< over the views sampled
  std::optional<UpperBound> certified;  ///< over all views there are
};

/// Indented JSON with a newline at the end; the same yardstick gives the same bytes.
[[nodiscard]] std::string yardstick_json(const Yardstick& yardstick);
[[nodiscard]] Expected<void> write_yardstick(const std::filesystem::path& path,
                                             const Yardstick& yardstick);
/// The error names the file, and the key or position. Unknown keys are skipped.
[[nodiscard]] Expected<Yardstick> read_yardstick(const std::filesystem::path& path);

}  // namespace canopeer
