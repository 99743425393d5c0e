#include "canopeer/campaign/comparison.h"

#include <fmt/format.h>

#include <algorithm>

namespace canopeer {
namespace {

std::vector<SampleFigures> figures_of(const std::vector<RunFigures>& runs) {
  std::vector<SampleFigures> result;
  for (std::size_t i = 0; i < figures().size(); ++i) {
    std::vector<double> values;
    for (const auto& run : runs) {
      if (run.values[i]) values.push_back(*run.values[i]);
    }
    result.push_back(sample_figures(values));
  }
  return result;
}

PairedComparison pair_up(const ContestantRuns& first, const ContestantRuns& other) {
  PairedComparison comparison;
  comparison.label = other.label;
  for (std::size_t i = 0; i < figures().size(); ++i) {
    std::vector<double> a;
    std::vector<double> b;
    for (const auto& run : first.runs) {
      const auto twin = std::find_if(other.runs.begin(), other.runs.end(),
                                     [&](const auto& r) { return r.job.seed == run.job.seed; });
      if (twin == other.runs.end() || !run.values[i] || !twin->values[i]) continue;
      a.push_back(*run.values[i]);
      b.push_back(*twin->values[i]);
    }
    comparison.figures.push_back(paired_figures(a, b));
  }
  return comparison;
}

std::vector<RunFigures> select(const std::vector<RunFigures>& runs, const std::string& mission,
                               const CampaignRules& rules, const std::string& label) {
  std::vector<RunFigures> selected;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(selected), [&](const RunFigures& r) {
    return r.job.mission_name == mission && r.job.budget_s == rules.budget_s &&
           r.job.protocol == rules.protocol && r.job.contestant.label() == label;
  });
  std::stable_sort(selected.begin(), selected.end(), [](const RunFigures& a, const RunFigures& b) {
    return a.job.seed < b.job.seed;
  });
  return selected;
}

}  // namespace

std::string Match::title() const {
  if (!protocol.empty()) return fmt::format("{}, protocol {}", mission, protocol);
  return budget_s ? fmt::format("{}, {:g} s per segment", mission, *budget_s) : mission;
}

bool Match::anybody_has(std::size_t figure) const {
  return std::any_of(contestants.begin(), contestants.end(),
                     [&](const ContestantRuns& c) { return c.figures[figure].count > 0; });
}

Comparison compare(const CampaignPlan& plan, const std::vector<RunFigures>& runs) {
  Comparison comparison;
  comparison.runs_planned = static_cast<int>(all_jobs(plan).size());
  comparison.runs_there = static_cast<int>(runs.size());
  for (const auto& mission : plan.missions) {
    for (const auto& rules : campaign_rules(plan)) {
      Match match;
      match.mission = mission.stem().string();
      match.budget_s = rules.budget_s;
      match.protocol = rules.protocol;
      for (const auto& contestant : plan.contestants) {
        ContestantRuns its{
            contestant.label(), select(runs, match.mission, rules, contestant.label()), {}};
        if (its.runs.empty()) continue;
        its.figures = figures_of(its.runs);
        match.fruits_total = std::max(match.fruits_total, its.runs.front().fruits_total);
        match.contestants.push_back(std::move(its));
      }
      for (std::size_t i = 1; i < match.contestants.size(); ++i) {
        match.against_first.push_back(pair_up(match.contestants[0], match.contestants[i]));
      }
      if (!match.contestants.empty()) comparison.matches.push_back(std::move(match));
    }
  }
  return comparison;
}

}  // namespace canopeer
