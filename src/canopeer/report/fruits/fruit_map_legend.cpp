#include "canopeer/report/fruits/fruit_map_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace canopeer {
namespace {

struct Item {
  std::string mark;
  std::string text;
};

std::string disc(const char* css_class) {
  return fmt::format("<circle r=\"7\" class=\"{}\"/>", css_class);
}

std::vector<Item> items_of(const std::vector<FruitVerdict>& verdicts,
                           const std::vector<FruitTruth>& truth) {
  const auto has = [&](Verdict verdict) {
    return std::any_of(verdicts.begin(), verdicts.end(),
                       [&](const FruitVerdict& v) { return v.verdict == verdict; });
  };
  std::vector<Item> items;
  if (has(Verdict::unscored)) items.push_back({disc("solid c0"), "reported fruit"});
  if (has(Verdict::found)) items.push_back({disc("solid c0"), "found, within 5 cm"});
  if (has(Verdict::near)) items.push_back({disc("solid c1"), "found, within 20 cm"});
  if (has(Verdict::wrong)) {
    items.push_back(
        {"<path d=\"M0 -7l7 7l-7 7l-7 -7z\" class=\"solid c2\"/>", "reported, no fruit there"});
  }
  if (has(Verdict::green)) items.push_back({disc("solid c3"), "reported, a green fruit"});
  const auto counted = std::count_if(truth.begin(), truth.end(),
                                     [](const FruitTruth& fruit) { return fruit.counted; });
  const auto found = std::count_if(verdicts.begin(), verdicts.end(),
                                   [](const FruitVerdict& v) { return v.truth.has_value(); });
  if (found > 0) items.push_back({disc("truth"), "true fruit"});
  if (found < counted) items.push_back({disc("missed"), "true fruit, not found"});
  if (counted < std::ssize(truth)) {
    items.push_back({disc("thin c3"), "green fruit, does not count"});
  }
  return items;
}

}  // namespace

FruitMapLegend fruit_map_legend(const std::vector<FruitVerdict>& verdicts,
                                const std::vector<FruitTruth>& truth, int width_px) {
  constexpr double kLeft = 8.0;
  constexpr double kLinePx = 20.0;
  constexpr double kLetterPx = 6.5;
  FruitMapLegend legend;
  double x = kLeft;
  double y = 16.0;
  for (const Item& item : items_of(verdicts, truth)) {
    const double width = 34.0 + kLetterPx * static_cast<double>(item.text.size());
    if (x > kLeft && x + width > width_px) {
      x = kLeft;
      y += kLinePx;
    }
    legend.svg += fmt::format(
        "<g transform=\"translate({:.1f} {:.1f})\">{}<text x=\"14\" y=\"4\" class=\"label\">{}"
        "</text></g>\n",
        x + 8.0, y, item.mark, item.text);
    x += width;
  }
  legend.height_px = y + 10.0;
  return legend;
}

}  // namespace canopeer
