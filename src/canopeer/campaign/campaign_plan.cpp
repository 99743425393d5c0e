#include "canopeer/campaign/campaign_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

namespace canopeer {
namespace {

template <typename List, typename Name>
std::optional<std::string> named_twice(const List& list, Name name) {
  std::set<std::string> seen;
  for (const auto& entry : list) {
    if (!seen.insert(name(entry)).second) return name(entry);
  }
  return std::nullopt;
}

std::string folder_of(std::string label) {
  std::replace(label.begin(), label.end(), '/', '_');
  return label;
}

}  // namespace

Expected<Contestant> parse_contestant(std::string_view text) {
  const std::size_t at = text.find('@');
  Contestant contestant{std::string(text.substr(0, at)), {}};
  if (at != std::string_view::npos) contestant.table = text.substr(at + 1);
  if (contestant.planner.empty() || (at != std::string_view::npos && contestant.table.empty())) {
    return fail(fmt::format("'{}': expected a planner, or planner@compute-table", text));
  }
  return contestant;
}

Expected<void> validate(const CampaignPlan& plan) {
  if (plan.missions.empty()) return fail("no mission given");
  if (plan.contestants.empty()) return fail("no planner given");
  const auto stem = [](const std::filesystem::path& p) { return p.stem().string(); };
  if (const auto name = named_twice(plan.missions, stem)) {
    return fail(fmt::format("two missions are called '{}'; rename one of the files", *name));
  }
  if (const auto name =
          named_twice(plan.contestants, [](const Contestant& c) { return c.label(); })) {
    return fail(fmt::format("planner '{}' is given twice", *name));
  }
  if (const auto name =
          named_twice(plan.budgets_s, [](double b) { return fmt::format("{:g}", b); })) {
    return fail(fmt::format("budget {} s is given twice", *name));
  }
  const auto itself = [](const std::string& protocol) { return protocol; };
  if (const auto name = named_twice(plan.protocols, itself)) {
    return fail(fmt::format("protocol '{}' is given twice", *name));
  }
  if (!plan.protocols.empty() && !plan.budgets_s.empty()) {
    return fail("protocols say how long a segment lasts; give either them or budgets");
  }
  if (plan.runs < 1) return fail("expected at least one run");
  if (plan.shards < 1 || plan.shard < 1 || plan.shard > plan.shards) {
    return fail(fmt::format("shard {}/{}: expected i/n with 1 ≤ i ≤ n", plan.shard, plan.shards));
  }
  return {};
}

std::vector<CampaignRules> campaign_rules(const CampaignPlan& plan) {
  std::vector<CampaignRules> rules;
  for (const double budget_s : plan.budgets_s) rules.push_back({budget_s, {}});
  for (const std::string& protocol : plan.protocols) rules.push_back({std::nullopt, protocol});
  if (rules.empty()) rules.emplace_back();
  return rules;
}

std::string CampaignRules::name() const {
  if (!protocol.empty()) return protocol;
  return budget_s ? fmt::format("{:g}s", *budget_s) : "full";
}

std::vector<CampaignJob> all_jobs(const CampaignPlan& plan) {
  std::vector<CampaignJob> jobs;
  for (int run = 0; run < plan.runs; ++run) {
    for (const auto& mission : plan.missions) {
      for (const auto& rules : campaign_rules(plan)) {
        for (const auto& contestant : plan.contestants) {
          CampaignJob job;
          job.mission = mission;
          job.mission_name = mission.stem().string();
          job.contestant = contestant;
          job.budget_s = rules.budget_s;
          job.protocol = rules.protocol;
          job.seed = plan.first_seed + static_cast<std::uint64_t>(run);
          job.dir = std::filesystem::path("runs") / job.mission_name / rules.name() /
                    folder_of(contestant.label()) / fmt::format("seed_{}", job.seed);
          jobs.push_back(std::move(job));
        }
      }
    }
  }
  return jobs;
}

std::vector<CampaignJob> shard_jobs(const CampaignPlan& plan) {
  const auto all = all_jobs(plan);
  std::vector<CampaignJob> mine;
  for (std::size_t i = static_cast<std::size_t>(plan.shard - 1); i < all.size();
       i += static_cast<std::size_t>(plan.shards)) {
    mine.push_back(all[i]);
  }
  return mine;
}

std::filesystem::path yardstick_of(const CampaignPlan& plan, const CampaignJob& job) {
  if (plan.yardsticks.empty() || job.budget_s) return {};
  const std::string file = (job.protocol.empty() ? "own" : job.protocol) + ".json";
  const std::filesystem::path world = plan.yardsticks / job.mission_name;
  for (const auto& path : {world / fmt::format("seed_{}", job.seed) / file, world / file}) {
    std::error_code code;
    if (std::filesystem::exists(path, code)) return path;
  }
  return {};
}

std::vector<std::string> run_arguments(const CampaignPlan& plan, const CampaignJob& job,
                                       const std::filesystem::path& out) {
  std::vector<std::string> words = {"run",
                                    job.mission.string(),
                                    "--no-replay",
                                    "--planner",
                                    job.contestant.planner,
                                    "--seed",
                                    std::to_string(job.seed),
                                    "--threads",
                                    std::to_string(plan.threads),
                                    "--quiet",
                                    "--out",
                                    out.string()};
  if (!job.contestant.table.empty()) {
    words.insert(words.end(), {"--compute-table", job.contestant.table});
  }
  if (job.budget_s) {
    words.insert(words.end(), {"--time-per-segment", fmt::format("{}", *job.budget_s)});
  }
  if (!job.protocol.empty()) words.insert(words.end(), {"--protocol", job.protocol});
  if (plan.segments) words.insert(words.end(), {"--segments", std::to_string(*plan.segments)});
  for (const auto& setting : plan.settings) words.insert(words.end(), {"--set", setting});
  return words;
}

}  // namespace canopeer
