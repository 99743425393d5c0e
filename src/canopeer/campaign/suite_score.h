#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/campaign/run_figures.h"
#include "canopeer/campaign/statistics.h"
#include "canopeer/campaign/suite.h"
#include "canopeer/record/yardstick.h"

namespace canopeer {

/// What of a run counts in the suite; the rest is in its folder.
struct SuiteRun {
  std::string world;
  std::string protocol;
  std::string planner;  ///< or planner@table
  std::uint64_t seed = 1;
  int fruits_total = 0;
  int detected = 0;        ///< within 0.05 m
  int detected_paper = 0;  ///< within 0.20 m
  double auc = 0.0;
  double mission_time_s = 0.0;
  int views = 0;
  int false_positives = 0;
  std::optional<double> surface_f1;
  std::optional<double> volume_error_mean;
  double joint_path_rad = 0.0;
  int collisions = 0;
};

[[nodiscard]] SuiteRun suite_run(const RunFigures& figures);

/// The AUC that a world's runs are divided by: the best that is known under the protocol.
struct SuiteReference {
  std::string world;
  std::string protocol;
  double auc = 0.0;
  std::string by;  ///< the planner that reached it
};

/// The greater AUC of the clairvoyant's and of the best known; nothing when neither is there.
[[nodiscard]] std::optional<SuiteReference> reference_of(const std::string& world,
                                                         const std::string& protocol,
                                                         const Yardstick& yardstick);

/// One number for a planner under a protocol.
struct SuiteScore {
  std::string planner;
  std::string protocol;
  int worlds = 0;
  int runs = 0;
  /// By a reference; else AUC itself, because some world has none.
  bool normalised = false;
  /// Mean over the worlds of each world's mean AUC / reference. The interval is the bootstrap's
  /// over worlds.
  SampleFigures value;
};

/// Planners and protocols in the order in which runs name them. Worlds count alike, however many
/// runs they have.
[[nodiscard]] std::vector<SuiteScore> suite_scores(const std::vector<SuiteRun>& runs,
                                                   const std::vector<SuiteReference>& references);
/// But for the last digits.
[[nodiscard]] bool same_scores(const std::vector<SuiteScore>& a, const std::vector<SuiteScore>& b);

}  // namespace canopeer
