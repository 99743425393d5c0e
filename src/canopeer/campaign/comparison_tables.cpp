#include "canopeer/campaign/comparison_tables.h"

#include <fmt/format.h>

namespace canopeer {
namespace {

std::string budget_text(const std::optional<double>& budget_s) {
  return budget_s ? fmt::format("{:g}", *budget_s) : "";
}

std::string figure_table(const Match& match) {
  std::string text = "| |";
  std::string rule = "|---|";
  for (const auto& c : match.contestants) {
    text += fmt::format(" {} (n = {}) |", c.label, c.runs.size());
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t i = 0; i < figures().size(); ++i) {
    if (!match.anybody_has(i)) continue;
    const Figure& figure = figures()[i];
    text += fmt::format("| {} |", figure.title);
    for (const auto& c : match.contestants) {
      const SampleFigures& f = c.figures[i];
      const std::string interval = interval_text(f, figure.decimals);
      text += fmt::format(" {}{} |", mean_text(f, figure.decimals),
                          interval.empty() ? "" : " [" + interval + "]");
    }
    text += "\n";
  }
  return text;
}

std::string paired_table(const Match& match) {
  if (match.against_first.empty()) return {};
  std::string text = fmt::format(
      "\nDifferences to {} over the seeds both have: mean [95 % interval], p by Wilcoxon's signed "
      "ranks, p by sign flips.\n\n| |",
      match.contestants.front().label);
  std::string rule = "|---|";
  for (const auto& other : match.against_first) {
    text += fmt::format(" {} |", other.label);
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t i = 0; i < figures().size(); ++i) {
    if (!match.anybody_has(i)) continue;
    const Figure& figure = figures()[i];
    text += fmt::format("| {} |", figure.title);
    for (const auto& other : match.against_first) {
      const PairedFigures& p = other.figures[i];
      const SampleFigures& d = p.difference;
      text += d.count == 0 ? " – |"
                           : fmt::format(" {:+.{}f} [{}], {}, {} |", d.mean, figure.decimals,
                                         interval_text(d, figure.decimals), p_text(p.p_wilcoxon),
                                         p_text(p.p_permutation));
    }
    text += "\n";
  }
  return text;
}

std::string difference_fields(const Match& match, std::size_t contestant, std::size_t figure) {
  if (contestant == 0) return ",,,,,";
  const PairedFigures& p = match.against_first[contestant - 1].figures[figure];
  const auto field = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string();
  };
  if (p.difference.count == 0) return "0,,,,,";
  return fmt::format("{},{:.6g},{:.6g},{:.6g},{},{}", p.difference.count, p.difference.mean,
                     p.difference.low95, p.difference.high95, field(p.p_wilcoxon),
                     field(p.p_permutation));
}

}  // namespace

std::string mean_text(const SampleFigures& f, int decimals) {
  if (f.count == 0) return "–";
  if (f.count == 1) return fmt::format("{:.{}f}", f.mean, decimals);
  return fmt::format("{:.{}f} ± {:.{}f}", f.mean, decimals, f.standard_deviation, decimals);
}

std::string interval_text(const SampleFigures& f, int decimals) {
  if (f.count < 2) return {};
  return fmt::format("{:.{}f} … {:.{}f}", f.low95, decimals, f.high95, decimals);
}

std::string p_text(const std::optional<double>& p) {
  if (!p) return "–";
  return *p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", *p);
}

std::string runs_csv(const std::vector<RunFigures>& runs) {
  std::string text = "mission,budget_s,planner,seed,fruits_total";
  for (const Figure& figure : figures()) text += fmt::format(",{}", figure.key);
  text += ",protocol\n";
  for (const auto& run : runs) {
    text += fmt::format("{},{},{},{},{}", run.job.mission_name, budget_text(run.job.budget_s),
                        run.job.contestant.label(), run.job.seed, run.fruits_total);
    for (const auto& value : run.values) text += value ? fmt::format(",{:.6g}", *value) : ",";
    text += "," + run.job.protocol + "\n";
  }
  return text;
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "mission,budget_s,planner,figure,n,mean,standard_deviation,low95,high95,pairs,difference,"
      "difference_low95,difference_high95,p_wilcoxon,p_permutation,protocol\n";
  for (const auto& match : comparison.matches) {
    for (std::size_t c = 0; c < match.contestants.size(); ++c) {
      for (std::size_t i = 0; i < figures().size(); ++i) {
        const SampleFigures& f = match.contestants[c].figures[i];
        const std::string numbers = f.count == 0
                                        ? ",,,"
                                        : fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", f.mean,
                                                      f.standard_deviation, f.low95, f.high95);
        text += fmt::format("{},{},{},{},{},{},{},{}\n", match.mission, budget_text(match.budget_s),
                            match.contestants[c].label, figures()[i].key, f.count, numbers,
                            difference_fields(match, c, i), match.protocol);
      }
    }
  }
  return text;
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = fmt::format(
      "# Comparison\n\n{} of {} runs. Mean ± standard deviation [95 % "
      "bootstrap interval of the mean].\n",
      comparison.runs_there, comparison.runs_planned);
  for (const auto& match : comparison.matches) {
    text += fmt::format("\n## {} ({} fruits)\n\n", match.title(), match.fruits_total);
    text += figure_table(match) + paired_table(match);
  }
  return text;
}

}  // namespace canopeer
