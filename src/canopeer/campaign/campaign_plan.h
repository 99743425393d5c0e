#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// A planner under a compute table: one curve of a comparison. Written `planner` or
/// `planner@table`.
struct Contestant {
  std::string planner;
  std::string table;  ///< name or file; empty: the mission's (or the planner's own)

  /// As it was written; names folders and curves.
  [[nodiscard]] std::string label() const {
    return table.empty() ? planner : planner + "@" + table;
  }
};

/// What a campaign is made of: every contestant on every mission with every budget and seed. The
/// seed fixes world and start, so runs of one seed are pairs.
struct CampaignPlan {
  std::vector<std::filesystem::path> missions;
  std::vector<Contestant> contestants;
  std::vector<double> budgets_s;  ///< per segment; empty: what the mission says
  /// Names of the rules (config/protocols.h), each a comparison of its own, in place of budgets;
  /// empty: the missions' own.
  std::vector<std::string> protocols{};
  std::filesystem::path yardsticks{};  ///< folder of them, see yardstick_of(); empty: none
  int runs = 5;                        ///< seeds first_seed … first_seed + runs − 1
  std::uint64_t first_seed = 1;
  std::optional<int> segments;        ///< only the first so many
  std::vector<std::string> settings;  ///< `dotted.key=value` for all runs
  int threads = 1;                    ///< of each run; results do not depend on it
  int shard = 1;                      ///< this process makes every `shards`-th run, from `shard`
  int shards = 1;
};

/// By what rules runs are compared: a budget per segment, a protocol, or neither, what the mission
/// says.
struct CampaignRules {
  std::optional<double> budget_s;
  std::string protocol;

  /// "20s", "tight10", "full": names folders.
  [[nodiscard]] std::string name() const;
  friend bool operator==(const CampaignRules&, const CampaignRules&) = default;
};

/// One run of a campaign.
struct CampaignJob {
  std::filesystem::path mission;
  std::string mission_name;  ///< stem of the file
  Contestant contestant;
  std::optional<double> budget_s;
  std::uint64_t seed = 1;
  /// Below the campaign's folder: runs/MISSION/BUDGET/LABEL/seed_N, PROTOCOL in place of BUDGET
  /// where there is one.
  std::filesystem::path dir;
  std::string protocol{};  ///< empty: the mission's own rules
};

/// "planner" or "planner@table". The error says what is wrong.
[[nodiscard]] Expected<Contestant> parse_contestant(std::string_view text);

/// Lists are not empty, no contestant, budget, protocol or mission name twice, numbers in range;
/// not both budgets and protocols.
[[nodiscard]] Expected<void> validate(const CampaignPlan& plan);

/// Those of the plan, in its order; at least one.
[[nodiscard]] std::vector<CampaignRules> campaign_rules(const CampaignPlan& plan);

/// All runs of the plan, whichever shard makes them: seed by seed, so that what is there when a
/// campaign is cut short is paired.
[[nodiscard]] std::vector<CampaignJob> all_jobs(const CampaignPlan& plan);
/// Those of the plan's shard.
[[nodiscard]] std::vector<CampaignJob> shard_jobs(const CampaignPlan& plan);

/// Where the yardstick of a run would be: MISSION/seed_N/PROTOCOL.json in the plan's folder of them
/// or, of a frozen world, MISSION/PROTOCOL.json, whichever is there; PROTOCOL is `own` without one.
/// Empty: there is none, or none can be, since budgets are nobody's protocol.
[[nodiscard]] std::filesystem::path yardstick_of(const CampaignPlan& plan, const CampaignJob& job);

/// The arguments of `canopeer` that make the run and leave it in `out`.
[[nodiscard]] std::vector<std::string> run_arguments(const CampaignPlan& plan,
                                                     const CampaignJob& job,
                                                     const std::filesystem::path& out);

}  // namespace canopeer
