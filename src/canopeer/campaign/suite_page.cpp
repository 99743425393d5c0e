#include "canopeer/campaign/suite_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "canopeer/campaign/comparison_report.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"

namespace canopeer {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> distinct(const std::vector<SuiteScore>& scores,
                                  std::string SuiteScore::*field) {
  std::vector<std::string> names;
  for (const SuiteScore& score : scores) {
    if (std::find(names.begin(), names.end(), score.*field) == names.end()) {
      names.push_back(score.*field);
    }
  }
  return names;
}

/// A row a planner, a column a protocol.
std::string numbers_html(const SuiteResults& results) {
  const auto protocols = distinct(results.scores, &SuiteScore::protocol);
  std::vector<std::string> head = {"planner"};
  for (const std::string& protocol : protocols) {
    const auto of = std::find_if(results.scores.begin(), results.scores.end(),
                                 [&](const SuiteScore& s) { return s.protocol == protocol; });
    head.push_back(escape_html(protocol) + (of->normalised ? "<br>AUC / best known" : "<br>AUC"));
  }
  Rows rows;
  for (const std::string& planner : distinct(results.scores, &SuiteScore::planner)) {
    std::vector<std::string> row = {escape_html(planner)};
    for (const std::string& protocol : protocols) {
      const auto found = std::find_if(
          results.scores.begin(), results.scores.end(),
          [&](const SuiteScore& s) { return s.planner == planner && s.protocol == protocol; });
      row.push_back(found == results.scores.end()
                        ? "–"
                        : score_text(*found) + fmt::format("<br><small>{} worlds, {} runs</small>",
                                                           found->worlds, found->runs));
    }
    rows.push_back(std::move(row));
  }
  return html_table(head, rows) +
         "<p class=\"note\">Mean over the worlds, and its 95 % bootstrap interval over worlds. "
         "AUC: "
         "mean of fruits found / all over the mission time, at 0.05 m. It is divided by the best "
         "known of each world where records/ has one for every world; docs/benchmark.md.</p>\n";
}

/// A row a world, a column a planner: mean AUC and fruits.
std::string worlds_html(const SuiteResults& results, const Suite& suite,
                        const std::string& protocol) {
  const auto planners = distinct(results.scores, &SuiteScore::planner);
  struct Sum {
    double auc = 0.0, detected = 0.0;
    int runs = 0;
  };
  std::map<std::pair<std::string, std::string>, Sum> sums;
  for (const SuiteRun& run : results.runs) {
    if (run.protocol != protocol) continue;
    Sum& sum = sums[{run.world, run.planner}];
    sum.auc += run.auc;
    sum.detected += run.detected;
    ++sum.runs;
  }
  std::vector<std::string> head = {"world", "split", "fruits", "best known AUC"};
  for (const std::string& planner : planners) head.push_back(escape_html(planner));
  Rows rows;
  for (const SuiteWorld& world : suite.worlds) {
    std::vector<std::string> row = {world.name, world.split, std::to_string(world.fruits_counted)};
    const auto best = std::find_if(
        results.references.begin(), results.references.end(),
        [&](const auto& r) { return r.world == world.name && r.protocol == protocol; });
    row.push_back(best == results.references.end() ? "–"
                                                   : fmt::format("{:.3f}<br><small>{}</small>",
                                                                 best->auc, escape_html(best->by)));
    bool any = false;
    for (const std::string& planner : planners) {
      const auto found = sums.find({world.name, planner});
      any = any || found != sums.end();
      row.push_back(found == sums.end() ? "–"
                                        : fmt::format("{:.3f}<br><small>{:.1f} found</small>",
                                                      found->second.auc / found->second.runs,
                                                      found->second.detected / found->second.runs));
    }
    if (any) rows.push_back(std::move(row));
  }
  return html_table(head, rows);
}

}  // namespace

std::string score_text(const SuiteScore& score) {
  const SampleFigures& v = score.value;
  if (v.count < 2) return fmt::format("{:.3f}", v.mean);
  return fmt::format("{:.3f} [{:.3f} … {:.3f}]", v.mean, v.low95, v.high95);
}

std::string suite_page(const SuiteResults& results, const Suite& suite,
                       const Comparison& comparison) {
  std::string body = fmt::format(
      "<h1>CanopeerBench</h1>\n<p>Suite {} ({:.12}), split {}, Canopeer {}.{}</p>\n", suite.version,
      suite.sha256, escape_html(results.split), escape_html(results.canopeer_version),
      results.settings.empty() ? "" : " <b>Settings were overridden: this is no entry.</b>");
  body += html_section("One number", numbers_html(results));
  for (const std::string& protocol : distinct(results.scores, &SuiteScore::protocol)) {
    body += html_section("Worlds, " + protocol, worlds_html(results, suite, protocol));
  }
  body += comparison_html(comparison);
  return html_page("CanopeerBench", body);
}

}  // namespace canopeer
