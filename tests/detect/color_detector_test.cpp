#include "canopeer/detect/color_detector.h"

#include <gtest/gtest.h>

#include "canopeer/detect/blobs.h"
#include "canopeer/detect/pixel_score.h"
#include "synthetic_view.h"

namespace canopeer {
namespace {

using namespace synthetic;

const Vec3 kCamera(-0.1, 0.0, 0.9);
const Vec3 kRow(0.6, 0.0, 0.8);

Body wall() { return block(Box(Vec3(1.0, -2.0, -1.0), Vec3(1.1, 2.0, 3.0)), {190, 195, 190}); }

Body leaf(double y) { return block(Box(Vec3(0.45, y, 0.6), Vec3(0.452, y + 0.05, 1.0)), kLeaf); }

std::vector<Body> plant() {
  return {wall(),
          superellipsoid({0.6, -0.15, 0.8}, {0.034, 0.034, 0.04}, 0.7, kRipe, true),
          superellipsoid({0.55, 0.0, 0.72}, {0.030, 0.030, 0.035}, 0.7, kTurning, true),
          ball({0.65, 0.18, 0.85}, 0.03, kRipe, true),
          ball({0.6, -0.22, 0.9}, 0.03, kGreen, false),
          block(Box(Vec3(0.6, 0.05, 0.9), Vec3(0.61, 0.13, 1.0)), kDryLeaf),
          leaf(-0.17),
          leaf(0.0)};
}

PixelScore score_of(const std::vector<Body>& bodies) {
  const View view = look(bodies, kCamera, kRow);
  PixelCounts counts;
  counts.add(ColorDetector().detect(view.frame)->fruit, view.fruit);
  return counts.score();
}

TEST(ColorDetector, FindsRipeAndTurningFruitsInLightAndShadeAndNoOtherThings) {
  const PixelScore score = score_of(plant());
  EXPECT_GT(score.precision, 0.97);
  EXPECT_GT(score.recall, 0.93);
}

TEST(ColorDetector, FindsNothingOnGreenFruitsLeavesAndDryLeaves) {
  std::vector<Body> bodies = plant();
  std::erase_if(bodies, [](const Body& body) { return body.fruit; });
  const View view = look(bodies, kCamera, kRow);
  PixelCounts counts;
  counts.add(ColorDetector().detect(view.frame)->fruit, view.fruit);
  EXPECT_EQ(counts.false_positives, 0);
}

TEST(ColorDetector, DropsPixelsWithoutDepthAndSpecks) {
  View view = look(plant(), kCamera, kRow);
  view.frame.color.at(10, 10) = kRipe;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 160; ++u) view.frame.depth.at(u, v) = 0.0F;
  }
  const Detection detection = *ColorDetector().detect(view.frame);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 160; ++u) ASSERT_EQ(detection.fruit.at(u, v), 0);
  }
}

TEST(ColorDetector, IsConfidentExactlyWhereItFindsFruit) {
  const View view = look(plant(), kCamera, kRow);
  const Detection detection = *ColorDetector().detect(view.frame);
  for (std::size_t i = 0; i < detection.fruit.pixels().size(); ++i) {
    const float confidence = detection.confidence.pixels()[i];
    ASSERT_EQ(confidence > 0.0F, detection.fruit.pixels()[i] != 0);
    ASSERT_LE(confidence, 1.0F);
  }
}

TEST(ColorDetector, ManyWindowsFindWhatTheyFindOneByOne) {
  ColorDetectorOptions options;
  options.windows.insert(options.windows.begin(), 45, {PixelLabel::ripe_fruit, 80.0, 81.0});
  const View view = look(plant(), kCamera, kRow);
  const Detection few = *ColorDetector().detect(view.frame);
  const Detection many = *ColorDetector(options).detect(view.frame);
  EXPECT_EQ(few.fruit.pixels(), many.fruit.pixels());
}

TEST(Blobs, EachPixelOfAMaskIsMetOnceInItsRow) {
  for (const int width : {1, 7, 8, 21}) {
    Mask mask(width, 5);
    for (std::size_t i = 0; i < mask.pixels().size(); i += 1 + i % 11) mask.pixels()[i] = 1;
    mask.pixels().back() = 1;
    Mask met(width, 5);
    for_each_pixel_in(mask, [&](int u, int v) { ++met.at(u, v); });
    EXPECT_EQ(met.pixels(), mask.pixels());
  }
}

TEST(ColorDetector, RefusesAnEmptyHueWindow) {
  ColorDetectorOptions options;
  options.windows[0].hue_low_deg = 40.0;
  EXPECT_FALSE(options.validate().has_value());
  EXPECT_TRUE(ColorDetectorOptions{}.validate().has_value());
}

TEST(PixelScore, CountsHitsMissesAndFalseAlarms) {
  Mask found(4, 1, 0);
  Mask truth(4, 1, 0);
  found.at(0, 0) = found.at(1, 0) = 1;
  truth.at(1, 0) = truth.at(2, 0) = truth.at(3, 0) = 1;
  PixelCounts counts;
  counts.add(found, truth);
  EXPECT_DOUBLE_EQ(counts.score().precision, 0.5);
  EXPECT_DOUBLE_EQ(counts.score().recall, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(counts.score().iou, 0.25);
  EXPECT_DOUBLE_EQ(PixelCounts{}.score().iou, 1.0);
}

}  // namespace
}  // namespace canopeer
