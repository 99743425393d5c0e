#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/campaign/campaign_plan.h"
#include "canopeer/report/run_files.h"

namespace canopeer {

enum class Better { more, less, neither };

/// One figure that planners are compared by.
struct Figure {
  const char* key;    ///< column in CSV files
  const char* title;  ///< for people, with unit
  int decimals;
  Better better;
};

/// All of them, in the order of the tables.
[[nodiscard]] std::span<const Figure> figures();
/// Index of the figure with that key, which must exist.
[[nodiscard]] std::size_t figure_index(std::string_view key);

/// What a comparison needs of one run.
struct RunFigures {
  CampaignJob job;
  std::vector<std::optional<double>> values;  ///< parallel to figures(); nothing: not measured
  int fruits_total = 0;
  /// Time within segments (transitions left out, as the paper counts), with `one_clock` mission
  /// time, and fruits found by then, at 0.20 m and at 0.05 m; one entry a frame.
  struct Found {
    double t_s = 0.0;
    int paper = 0;
    int strict = 0;
  };
  std::vector<Found> found;
  bool one_clock = false;                        ///< that never stops
  double planned_s = 0.0;                        ///< all segments together, by that clock
  std::vector<double> intervals_s;               ///< between views of the same segment
  std::vector<std::pair<double, double>> gains;  ///< predicted, realised; views with a prediction
};

[[nodiscard]] RunFigures run_figures(const CampaignJob& job, const RunFiles& files);

/// Reads a finished run of the campaign in `out`. `yardstick`: the file of it (yardstick_of()) that
/// the run is held against, whatever its summary says; empty: as it says. The error: files that
/// cannot be read, or a yardstick of another world or protocol.
[[nodiscard]] Expected<RunFigures> read_run_figures(const std::filesystem::path& out,
                                                    const CampaignJob& job,
                                                    const std::filesystem::path& yardstick = {});

}  // namespace canopeer
