#include "canopeer/campaign/comparison_plots.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace canopeer {
namespace {

constexpr int kTimeSteps = 240;
constexpr std::size_t kMostDots = 400;

/// What was found by then.
int found_at(const RunFigures& run, double t_s) {
  int found = 0;
  for (const auto& f : run.found) {
    if (f.t_s > t_s) break;
    found = f.paper;
  }
  return found;
}

double longest(const Match& match) {
  double end_s = 0.0;
  for (const auto& c : match.contestants) {
    for (const auto& run : c.runs) end_s = std::max(end_s, run.planned_s);
  }
  return end_s;
}

void add_course(SvgPlot& plot, int colour, const ContestantRuns& contestant, double end_s) {
  SvgPlot::Points mean;
  SvgPlot::Points low;
  SvgPlot::Points high;
  for (int i = 0; i <= kTimeSteps; ++i) {
    const double t_s = end_s * i / kTimeSteps;
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& run : contestant.runs) {
      const double found = found_at(run, t_s);
      sum += found;
      squares += found * found;
    }
    const auto n = static_cast<double>(contestant.runs.size());
    const double m = sum / n;
    const double deviation =
        n > 1 ? std::sqrt(std::max(0.0, (squares - n * m * m) / (n - 1))) : 0.0;
    mean.emplace_back(t_s, m);
    low.emplace_back(t_s, std::max(0.0, m - deviation));
    high.emplace_back(t_s, m + deviation);
  }
  plot.add_band(colour, low, high);
  plot.add_line(contestant.label, colour, std::move(mean));
}

/// A mission has one clock for all who are compared on it, unless a contestant's settings change
/// it.
std::string time_label(const Match& match) {
  bool one = false;
  bool own = false;
  for (const auto& c : match.contestants) {
    for (const auto& run : c.runs) (run.one_clock ? one : own) = true;
  }
  if (one && own) return "time in segments, or mission time / s";
  return one ? "mission time / s" : "time in segments / s";
}

}  // namespace

SvgPlot found_plot(const Match& match) {
  SvgPlot plot(
      {"Fruits found over time: " + match.title(), time_label(match), "fruits found (0.20 m)"});
  plot.include(0.0, 0.0);
  const double end_s = longest(match);
  int colour = 0;
  for (const auto& contestant : match.contestants) add_course(plot, colour++, contestant, end_s);
  if (match.fruits_total > 0) {
    plot.mark_y(match.fruits_total, std::to_string(match.fruits_total) + " fruits");
  }
  return plot;
}

SvgPlot interval_plot(const Match& match) {
  SvgPlot plot({"Time between views: " + match.title(), "", "time between views / s"});
  int colour = 0;
  for (const auto& contestant : match.contestants) {
    std::vector<double> all;
    for (const auto& run : contestant.runs) {
      all.insert(all.end(), run.intervals_s.begin(), run.intervals_s.end());
    }
    plot.add_box(contestant.label, colour++, sample_spread(std::move(all)));
  }
  return plot;
}

std::optional<SvgPlot> gain_plot(const Match& match) {
  SvgPlot plot({"Predicted and realised gain: " + match.title(), "predicted gain / voxels",
                "realised gain / voxels"});
  plot.include(0.0, 0.0);
  bool any = false;
  int colour = -1;
  for (const auto& contestant : match.contestants) {
    ++colour;
    SvgPlot::Points all;
    for (const auto& run : contestant.runs)
      all.insert(all.end(), run.gains.begin(), run.gains.end());
    if (all.empty()) continue;
    SvgPlot::Points some;
    const std::size_t step = all.size() / kMostDots + 1;
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    plot.add_dots(contestant.label, colour, std::move(some));
    any = true;
  }
  if (!any) return std::nullopt;
  return plot;
}

std::optional<SvgPlot> budget_plot(const std::vector<const Match*>& matches) {
  if (matches.size() < 2 || !matches.front()->budget_s) return std::nullopt;
  SvgPlot plot({"Fruits found over the budget", "budget per segment / s", "fruits found (0.20 m)"});
  plot.include(0.0, 0.0);
  std::map<std::string, std::pair<int, SvgPlot::Points>> lines;
  std::map<std::string, std::pair<SvgPlot::Points, SvgPlot::Points>> bands;
  std::vector<std::string> order;
  const std::size_t figure = figure_index("detected_paper");
  for (const Match* match : matches) {
    for (const auto& c : match->contestants) {
      if (lines.try_emplace(c.label, static_cast<int>(order.size()), SvgPlot::Points{}).second) {
        order.push_back(c.label);
      }
      const SampleFigures& f = c.figures[figure];
      lines[c.label].second.emplace_back(*match->budget_s, f.mean);
      bands[c.label].first.emplace_back(*match->budget_s, f.mean - f.standard_deviation);
      bands[c.label].second.emplace_back(*match->budget_s, f.mean + f.standard_deviation);
    }
  }
  for (const auto& label : order) {
    const int colour = lines[label].first;
    plot.add_band(colour, bands[label].first, bands[label].second);
    plot.add_line(label, colour, lines[label].second);
  }
  if (matches.front()->fruits_total > 0) {
    plot.mark_y(matches.front()->fruits_total,
                std::to_string(matches.front()->fruits_total) + " fruits");
  }
  return plot;
}

}  // namespace canopeer
