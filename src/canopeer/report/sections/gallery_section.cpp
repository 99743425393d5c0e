#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "canopeer/fruit/missing_surface.h"
#include "canopeer/report/fruit_gallery.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

constexpr std::size_t kWorst = 5;

struct Case {
  GalleryFruit fruit;
  double badness = 0.0;
};

std::string percent(double value) { return fmt::format("{:+.0f} %", 100.0 * value); }

/// How far off a fruit is, in units of what is still good: 8 mm, 15 %; what is no fruit at all is
/// worse than any. Without truth: how unsure.
void judge(const FruitVerdict& verdict, Case& item) {
  const FruitEstimate& e = item.fruit.estimate;
  if (verdict.verdict == Verdict::unscored) {
    item.badness = 1.0 - e.confidence + e.volume_sd_cm3 / std::max(1.0, e.volume_cm3);
    return;
  }
  if (verdict.verdict == Verdict::green) item.fruit.verdict = "a green fruit";
  if (verdict.verdict == Verdict::wrong) {
    item.fruit.verdict = "no fruit there";
    item.badness = 1e6 + e.confidence;
  }
  if (!item.fruit.truth) return;
  const double true_cm3 = item.fruit.truth->volume_cm3;
  const double volume = true_cm3 > 0.0 ? e.volume_cm3 / true_cm3 - 1.0 : 0.0;
  item.badness = verdict.distance_m / 0.008 + std::abs(volume) / 0.15;
  item.fruit.verdict =
      fmt::format("{:.1f} mm off, volume {}", 1e3 * verdict.distance_m, percent(volume));
}

std::vector<Case> cases_of(const ReportData& data) {
  const RunFiles& files = data.files;
  std::map<int, std::vector<std::size_t>> points_of;
  for (std::size_t i = 0; i < files.surface.fruit.size(); ++i) {
    if (files.surface.fruit[i] >= 0) points_of[files.surface.fruit[i]].push_back(i);
  }
  std::vector<Case> cases;
  for (std::size_t i = 0; i < files.fruits.size(); ++i) {
    Case item;
    item.fruit.estimate = files.fruits[i];
    const PointCloud& cloud = files.surface.cloud;
    std::vector<SurfacePoint> seen;
    for (const std::size_t k : points_of[files.fruits[i].id]) {
      item.fruit.points.push_back(cloud.points[k].cast<double>());
      seen.push_back({item.fruit.points.back(), Vec3::UnitZ()});
      if (!cloud.colors.empty()) item.fruit.colors.push_back(cloud.colors[k]);
    }
    for (const SurfacePoint& s : missing_surface(files.fruits[i].body(), seen).points) {
      item.fruit.missing.push_back(s.point);
    }
    if (data.verdicts[i].truth) item.fruit.truth = files.truth[*data.verdicts[i].truth];
    judge(data.verdicts[i], item);
    cases.push_back(std::move(item));
  }
  std::stable_sort(cases.begin(), cases.end(),
                   [](const Case& a, const Case& b) { return a.badness > b.badness; });
  return cases;
}

}  // namespace

std::string gallery_section(const ReportData& data) {
  if (data.files.surface.fruit.empty() || data.files.fruits.empty()) return {};
  std::vector<GalleryFruit> worst;
  std::vector<GalleryFruit> others;
  for (Case& item : cases_of(data)) {
    (worst.size() < kWorst ? worst : others).push_back(std::move(item.fruit));
  }
  constexpr int kWidthPx = 880;
  const auto sheet = [](const std::vector<GalleryFruit>& fruits) {
    return "<div class=\"scroll\">" + fruit_gallery_svg(fruits, kWidthPx, false) + "</div>\n";
  };
  std::string html = fmt::format(
      "<p class=\"note\">The worst {} first. Dots: the surface seen, in its colours. "
      "Solid line: the fitted shape; pale dots on it: surface nobody saw.{}</p>\n",
      worst.size(), data.files.truth.empty() ? "" : " Dashed: the true size.");
  html += sheet(worst);
  if (!others.empty()) {
    html += html_details(fmt::format("The other {} fruits", others.size()), sheet(others));
  }
  return html_section("Shapes", html);
}

}  // namespace canopeer
