#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "canopeer/base/rng.h"
#include "canopeer/report/drawing/axis_ticks.h"
#include "canopeer/report/drawing/base64.h"
#include "canopeer/report/fruits/fruit_verdicts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sample_spread.h"
#include "canopeer/report/svg_plot.h"

namespace canopeer {
namespace {

TEST(AxisTicks, AreRoundNumbersInsideTheRange) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const double low = rng.normal(0.0, 100.0);
    const double high = low + std::pow(10.0, rng.uniform(-3.0, 5.0));
    const AxisTicks ticks = axis_ticks(low, high, 6);
    ASSERT_GE(ticks.values.size(), 2U) << low << " " << high;
    ASSERT_LE(ticks.values.size(), 7U) << low << " " << high;
    for (std::size_t k = 0; k < ticks.values.size(); ++k) {
      EXPECT_GE(ticks.values[k], low - 1e-6 * (high - low));
      EXPECT_LE(ticks.values[k], high + 1e-6 * (high - low));
      if (k > 0) {
        EXPECT_NE(ticks.label(ticks.values[k]), ticks.label(ticks.values[k - 1]));
      }
    }
  }
  EXPECT_EQ(axis_ticks(0.0, 47.0, 5, true).values, (std::vector<double>{0, 10, 20, 30, 40}));
  EXPECT_EQ(axis_ticks(0.0, 1.0, 5, true).values, (std::vector<double>{0, 1}));
  EXPECT_EQ(axis_ticks(-0.5, 0.5, 2).label(-0.5), "\u22120.5");
}

TEST(SampleSpread, GivesQuartilesWhiskersAndOutliers) {
  const SampleSpread spread = sample_spread({5, 1, 2, 3, 4, 100});
  EXPECT_EQ(spread.median, 3.5);
  EXPECT_EQ(spread.lower_quartile, 2.25);
  EXPECT_EQ(spread.upper_quartile, 4.75);
  EXPECT_EQ(spread.lower_whisker, 1.0);
  EXPECT_EQ(spread.upper_whisker, 5.0);
  EXPECT_EQ(spread.outliers, std::vector<double>{100.0});
  EXPECT_EQ(sample_spread({}).count, 0U);
}

TEST(Base64, MatchesTheExamplesOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(HtmlText, EscapesAndGroups) {
  EXPECT_EQ(escape_html("<a b=\"c\"> & d"), "&lt;a b=&quot;c&quot;&gt; &amp; d");
  EXPECT_EQ(duration_text(48.23), "48.2 s");
  EXPECT_EQ(duration_text(500.4), "8 min 20 s");
  EXPECT_EQ(duration_text(7500.0), "2 h 05 min");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1234567), "1\u202f234\u202f567");
}

TEST(SvgPlot, StepsKeepTheirValueUntilTheNextPoint) {
  SvgPlot plot({"t", "x", "y"});
  plot.add_steps("s", 0, {{0, 0}, {1, 0}, {2, 0}, {3, 5}, {4, 5}});
  const std::string svg = plot.svg(400, 300);
  const std::size_t begin = svg.find("points=\"") + 8;
  const std::string points = svg.substr(begin, svg.find('"', begin) - begin);
  // (0, 0), (3, 0), (3, 5), (4, 5): flat stretches are one line.
  EXPECT_EQ(std::count(points.begin(), points.end(), ','), 4);
}

TEST(FruitVerdicts, TellFoundNearGreenAndWrongApart) {
  std::vector<FruitTruth> truth(3);
  truth[0].centre = {0, 0, 0};
  truth[1].centre = {1, 0, 0};
  truth[2].centre = {2, 0, 0};
  truth[2].counted = false;
  std::vector<FruitEstimate> fruits(4);
  fruits[0].centre = {0.02, 0, 0};
  fruits[1].centre = {1.1, 0, 0};
  fruits[2].centre = {2.01, 0, 0};
  fruits[3].centre = {3, 0, 0};
  const std::vector<FruitVerdict> v = fruit_verdicts(fruits, truth);
  EXPECT_EQ(v[0].verdict, Verdict::found);
  EXPECT_EQ(v[0].truth, 0U);
  EXPECT_EQ(v[1].verdict, Verdict::near);
  EXPECT_NEAR(v[1].distance_m, 0.1, 1e-12);
  EXPECT_EQ(v[2].verdict, Verdict::green);
  EXPECT_EQ(v[3].verdict, Verdict::wrong);
  EXPECT_EQ(fruit_verdicts(fruits, {})[0].verdict, Verdict::unscored);
}

}  // namespace
}  // namespace canopeer
