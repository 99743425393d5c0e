#include "canopeer/campaign/comparison_report.h"

#include <fmt/format.h>

#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/comparison_plots.h"
#include "canopeer/campaign/comparison_tables.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr int kWidePx = 880;
constexpr int kTallPx = 340;
constexpr int kFlatPx = 280;

std::string figures_html(const Match& match) {
  std::vector<std::string> head = {""};
  for (const auto& c : match.contestants) {
    head.push_back(fmt::format("{}<br>n = {}", escape_html(c.label), c.runs.size()));
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < figures().size(); ++i) {
    if (!match.anybody_has(i)) continue;
    const Figure& figure = figures()[i];
    std::vector<std::string> row = {figure.title};
    for (const auto& c : match.contestants) {
      const std::string interval = interval_text(c.figures[i], figure.decimals);
      row.push_back(mean_text(c.figures[i], figure.decimals) +
                    (interval.empty() ? "" : "<br><small>" + interval + "</small>"));
    }
    rows.push_back(std::move(row));
  }
  return html_table(head, rows) +
         "<p class=\"note\">Mean ± standard deviation over the runs; below it the 95 % bootstrap "
         "interval of the mean. Times to a share of the fruits are mission time at 0.05 m, over "
         "the "
         "runs that reached it.</p>\n";
}

std::string pairs_html(const Match& match) {
  if (match.against_first.empty()) return {};
  std::vector<std::string> head = {"against " + escape_html(match.contestants.front().label)};
  for (const auto& other : match.against_first) {
    head.push_back(fmt::format("{}<br>difference", escape_html(other.label)));
    head.emplace_back("p");
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < figures().size(); ++i) {
    if (!match.anybody_has(i)) continue;
    const Figure& figure = figures()[i];
    std::vector<std::string> row = {figure.title};
    for (const auto& other : match.against_first) {
      const PairedFigures& p = other.figures[i];
      const SampleFigures& d = p.difference;
      if (d.count == 0) {
        row.insert(row.end(), {"–", "–"});
        continue;
      }
      row.push_back(fmt::format("{:+.{}f}<br><small>{}</small>", d.mean, figure.decimals,
                                interval_text(d, figure.decimals)));
      row.push_back(p_text(p.p_wilcoxon) + "<br><small>" + p_text(p.p_permutation) + "</small>");
    }
    rows.push_back(std::move(row));
  }
  return html_details(
      "Paired tests",
      html_table(head, rows) +
          "<p class=\"note\">Over the seeds both have. p: Wilcoxon's signed ranks; "
          "below it the sign-flip permutation test. Not corrected for the number of "
          "figures.</p>\n");
}

std::string match_html(const Match& match) {
  std::string html = "<h3>Fruits over time</h3>\n" + html_plot(found_plot(match), kTallPx, 280) +
                     "<p class=\"note\">Mean and band of one standard deviation; transitions "
                     "between segments left out, as the paper counts.</p>\n"
                     "<h3>Time between views</h3>\n" +
                     html_plot(interval_plot(match), kFlatPx, 240);
  html += "<h3>All figures</h3>\n" + figures_html(match) + pairs_html(match);
  if (const auto plot = gain_plot(match)) {
    html += html_details("Predicted and realised gain", html_plot(*plot, kTallPx, 280));
  }
  return html_section(fmt::format("{}: {} fruits", match.title(), match.fruits_total), html);
}

/// The matches of each mission, together.
std::vector<std::vector<const Match*>> by_mission(const Comparison& comparison) {
  std::vector<std::vector<const Match*>> groups;
  for (const auto& match : comparison.matches) {
    if (groups.empty() || groups.back().front()->mission != match.mission) groups.emplace_back();
    groups.back().push_back(&match);
  }
  return groups;
}

std::string headline_html(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  const std::size_t paper = figure_index("detected_paper");
  const std::size_t strict = figure_index("detected");
  const std::size_t auc = figure_index("auc");
  for (const auto& match : comparison.matches) {
    for (const auto& c : match.contestants) {
      rows.push_back({escape_html(match.title()), escape_html(c.label),
                      std::to_string(c.runs.size()), mean_text(c.figures[paper], 1),
                      mean_text(c.figures[strict], 1), std::to_string(match.fruits_total),
                      mean_text(c.figures[auc], 3)});
    }
  }
  const std::string missing = comparison.runs_there == comparison.runs_planned
                                  ? fmt::format("{} runs.", comparison.runs_there)
                                  : fmt::format("{} of {} runs; the others are not done yet.",
                                                comparison.runs_there, comparison.runs_planned);
  return "<h1>Planners compared</h1>\n<p>" + missing +
         " Same seeds, so same worlds and starts, for all planners.</p>\n" +
         html_table({"mission", "planner", "runs", "found, 0.20 m", "found, 0.05 m", "of", "AUC"},
                    rows);
}

}  // namespace

std::string comparison_html(const Comparison& comparison) {
  std::string body = headline_html(comparison);
  for (const auto& group : by_mission(comparison)) {
    if (const auto plot = budget_plot(group)) {
      body += html_section(group.front()->mission + ": results by budget",
                           html_plot(*plot, kTallPx, 280));
    }
    for (const Match* match : group) body += match_html(*match);
  }
  return body;
}

namespace {

Expected<void> write_plots(const fs::path& dir, const Comparison& comparison) {
  std::error_code code;
  fs::create_directories(dir, code);
  if (code) return fail(dir.string() + ": cannot be made: " + code.message());
  for (const auto& match : comparison.matches) {
    std::string name = match.mission;
    if (match.budget_s) name += fmt::format("_{:g}s", *match.budget_s);
    if (!match.protocol.empty()) name += "_" + match.protocol;
    const auto write = [&](const char* what, const SvgPlot& plot, int height_px) {
      return write_file(dir / fmt::format("{}_{}.svg", name, what),
                        plot.svg_file(kWidePx, height_px));
    };
    if (auto ok = write("found", found_plot(match), kTallPx); !ok) return ok;
    if (auto ok = write("intervals", interval_plot(match), kFlatPx); !ok) return ok;
    if (const auto plot = gain_plot(match)) {
      if (auto ok = write("gains", *plot, kTallPx); !ok) return ok;
    }
  }
  for (const auto& group : by_mission(comparison)) {
    const auto plot = budget_plot(group);
    if (!plot) continue;
    const fs::path path = dir / (group.front()->mission + "_budgets.svg");
    if (auto ok = write_file(path, plot->svg_file(kWidePx, kTallPx)); !ok) return ok;
  }
  return {};
}

}  // namespace

Expected<void> write_comparison(const fs::path& out, const CampaignPlan& plan,
                                const std::vector<RunFigures>& runs) {
  const Comparison comparison = compare(plan, runs);
  if (auto ok = write_file(out / "runs.csv", runs_csv(runs)); !ok) return ok;
  if (auto ok = write_file(out / "comparison.csv", comparison_csv(comparison)); !ok) return ok;
  if (auto ok = write_file(out / "comparison.md", comparison_markdown(comparison)); !ok) return ok;
  if (auto ok = write_plots(out / "plots", comparison); !ok) return ok;
  return write_file(out / "comparison.html",
                    html_page("canopeer: planners compared", comparison_html(comparison)));
}

}  // namespace canopeer
