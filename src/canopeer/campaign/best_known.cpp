#include "canopeer/campaign/best_known.h"

#include <fmt/format.h>

#include <algorithm>

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr double kSameAuc = 1e-12;  // a number went through text

bool has_greater_auc(const BestResult& a, const BestResult& b) { return a.auc > b.auc + kSameAuc; }

void check_bound(const char* name, const std::optional<UpperBound>& bound,
                 const std::optional<BestResult>& most, const std::optional<BestResult>& best_auc,
                 std::vector<std::string>& found) {
  if (!bound) return;
  if (bound->fruits && most && most->detected > *bound->fruits + 1e-6) {
    found.push_back(fmt::format("{} fruits were found by {}, the {} bound is {:g}", most->detected,
                                most->planner, name, *bound->fruits));
  }
  if (bound->auc && best_auc && best_auc->auc > *bound->auc + 1e-6) {
    found.push_back(fmt::format("AUC {:.4f} was reached by {}, the {} bound is {:.4f}",
                                best_auc->auc, best_auc->planner, name, *bound->auc));
  }
}

}  // namespace

fs::path mission_record(const std::string& mission, std::uint64_t world_seed,
                        const std::string& protocol) {
  return fs::path(mission) / fmt::format("seed_{}", world_seed) / (protocol + ".json");
}

fs::path suite_record(const std::string& world, const std::string& protocol) {
  return fs::path("suite") / world / (protocol + ".json");
}

Expected<std::optional<Yardstick>> known_yardstick(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) return std::optional<Yardstick>();
  auto yardstick = read_yardstick(path);
  if (!yardstick) return tl::unexpected(yardstick.error());
  return std::optional<Yardstick>(std::move(*yardstick));
}

bool finds_more(const BestResult& a, const BestResult& b) {
  return a.detected > b.detected || (a.detected == b.detected && has_greater_auc(a, b));
}

Yardstick with_better_of(Yardstick found, const Yardstick& known) {
  const auto take = [](std::optional<BestResult>& mine, const std::optional<BestResult>& theirs,
                       auto better) {
    if (theirs && (!mine || better(*theirs, *mine))) mine = theirs;
  };
  take(found.clairvoyant, known.clairvoyant, has_greater_auc);
  take(found.best_found, known.best_found, finds_more);
  take(found.best_auc, known.best_auc, has_greater_auc);
  return found;
}

std::optional<Yardstick> improved_by(const Yardstick& known, const RunFigures& run,
                                     const std::string& version,
                                     const std::vector<std::string>& settings) {
  BestResult result;
  result.detected = static_cast<int>(run.values[figure_index("detected")].value_or(0.0));
  result.auc = run.values[figure_index("auc")].value_or(0.0);
  result.planner = run.job.contestant.planner;
  result.version = version;
  result.seed = run.job.seed;
  result.settings = settings;
  if (!run.job.contestant.table.empty()) {
    result.settings.push_back("compute_table=" + run.job.contestant.table);
  }
  Yardstick better = known;
  const bool more = !known.best_found || finds_more(result, *known.best_found);
  const bool sooner = !known.best_auc || has_greater_auc(result, *known.best_auc);
  if (more) better.best_found = result;
  if (sooner) better.best_auc = result;
  return more || sooner ? std::optional(better) : std::nullopt;
}

std::vector<std::string> contradictions(const Yardstick& y) {
  std::vector<std::string> found;
  for (const auto& result : {y.clairvoyant, y.best_found, y.best_auc}) {
    if (!result) continue;
    if (result->detected < 0 || result->detected > y.fruits_total) {
      found.push_back(fmt::format("{} of {} fruits were found by {}", result->detected,
                                  y.fruits_total, result->planner));
    }
    if (!(result->auc >= 0.0 && result->auc <= 1.0)) {
      found.push_back(fmt::format("an AUC of {} is none, by {}", result->auc, result->planner));
    }
  }
  if (y.clairvoyant && y.best_found && y.clairvoyant->detected > y.best_found->detected) {
    found.emplace_back("the clairvoyant plan found more fruits than the best known result");
  }
  if (y.clairvoyant && y.best_auc && y.clairvoyant->auc > y.best_auc->auc + kSameAuc) {
    found.emplace_back("the clairvoyant plan has a greater AUC than the best known result");
  }
  if (y.ceiling_fruits && y.best_found && y.best_found->detected > *y.ceiling_fruits) {
    found.push_back(fmt::format("{} fruits were found by {}, only {} can be seen",
                                y.best_found->detected, y.best_found->planner, *y.ceiling_fruits));
  }
  check_bound("sampled", y.sampled, y.best_found, y.best_auc, found);
  check_bound("certified", y.certified, y.best_found, y.best_auc, found);
  return found;
}

}  // namespace canopeer
