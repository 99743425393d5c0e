#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "canopeer/base/rng.h"
#include "canopeer/detect/detector_registry.h"
#include "canopeer/detect/pixel_score.h"
#include "synthetic_view.h"

namespace canopeer {
namespace {

using namespace synthetic;

const std::filesystem::path kModels = CANOPEER_SOURCE_DIR "/tests/detect/models";

View plant() {
  View view = look({block(Box(Vec3(1.0, -2.0, -1.0), Vec3(1.1, 2.0, 3.0)), {190, 195, 190}),
                    superellipsoid({0.6, -0.15, 0.8}, {0.034, 0.034, 0.04}, 0.7, kRipe, true),
                    superellipsoid({0.55, 0.0, 0.72}, {0.030, 0.030, 0.035}, 0.7, kTurning, true),
                    ball({0.6, -0.22, 0.9}, 0.03, kGreen, false),
                    block(Box(Vec3(0.45, -0.17, 0.6), Vec3(0.452, -0.12, 1.0)), kLeaf)},
                   {-0.1, 0.0, 0.9}, {0.6, 0.0, 0.8});
  view.frame.labels = Image<PixelLabel>(320, 240);
  for (std::size_t i = 0; i < view.fruit.pixels().size(); ++i) {
    if (view.fruit.pixels()[i] != 0) view.frame.labels.pixels()[i] = PixelLabel::ripe_fruit;
  }
  return view;
}

PixelScore score(const Detector& detector, const View& view) {
  const auto detection = detector.detect(view.frame);
  EXPECT_TRUE(detection.has_value());
  PixelCounts counts;
  counts.add(detection->fruit, view.fruit);
  return counts.score();
}

NetworkDetectorOptions colour_rule() {
  NetworkDetectorOptions options;
  options.model = kModels / "colour_rule.onnx";
  options.input_width_px = 320;
  options.input_height_px = 240;
  return options;
}

TEST(Detectors, AllLabelOnlyWhatTheyReportAndAreConfidentOfNothingElse) {
  const View view = plant();
  const DetectorRegistry registry = DetectorRegistry::built_in();
  for (const std::string& name : registry.names()) {
    DetectorOptions options;
    options.kind = name;
    options.network = colour_rule();
    const auto detector = registry.make(options);
    ASSERT_TRUE(detector.has_value()) << name << ": " << detector.error().message;
    const auto detection = (*detector)->detect(view.frame);
    ASSERT_TRUE(detection.has_value());
    int fruit = 0;
    for (std::size_t i = 0; i < view.fruit.pixels().size(); ++i) {
      const PixelLabel label = detection->label.pixels()[i];
      const float confidence = detection->confidence.pixels()[i];
      const int in = detection->fruit.pixels()[i];
      EXPECT_EQ(in, counted_fruit(label) ? static_cast<int>(label) : 0);
      EXPECT_TRUE(confidence >= 0.0F && confidence <= 1.0F);
      EXPECT_EQ(confidence > 0.0F, label != PixelLabel::background);
      fruit += in != 0;
    }
    EXPECT_GT(fruit, 500) << name;
  }
}

TEST(Detectors, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  DetectorOptions options;
  options.kind = "oracle";
  const auto detector = DetectorRegistry::built_in().make(options);
  ASSERT_FALSE(detector.has_value());
  EXPECT_NE(detector.error().message.find("'oracle'"), std::string::npos);
  EXPECT_NE(detector.error().message.find("colour, labels, network"), std::string::npos);
}

TEST(Detectors, OneFromOutsideIsMadeWithItsOwnOptions) {
  DetectorRegistry registry = DetectorRegistry::built_in();
  const auto factory = [](const DetectorOptions& o) -> Expected<std::unique_ptr<Detector>> {
    LabelDetectorOptions labels;
    const auto confidence = o.own.find("confidence");
    if (confidence == o.own.end()) return fail("'confidence' is missing");
    labels.confidence = std::stod(confidence->second);
    return std::make_unique<LabelDetector>(labels);
  };
  EXPECT_FALSE(registry.add("labels", "", factory).has_value());
  EXPECT_FALSE(registry.add("Doubtful", "", factory).has_value());
  ASSERT_TRUE(registry.add("doubtful", "labels, but not quite sure", factory).has_value());
  EXPECT_EQ(registry.names().back(), "doubtful");
  EXPECT_EQ(registry.one_line("doubtful"), "labels, but not quite sure");

  DetectorOptions options;
  options.kind = "doubtful";
  EXPECT_EQ(registry.make(options).error().message, "'confidence' is missing");
  options.own["confidence"] = "0.25";
  const auto detector = registry.make(options);
  ASSERT_TRUE(detector.has_value());
  const auto detection = (*detector)->detect(plant().frame);
  ASSERT_TRUE(detection.has_value());
  const auto& confidences = detection->confidence.pixels();
  EXPECT_EQ(*std::max_element(confidences.begin(), confidences.end()), 0.25F);
}

TEST(ColorDetector, TellsTurningFromRipe) {
  const View view = plant();
  const auto detection = ColorDetector().detect(view.frame);
  int right = 0;
  int all = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (detection->fruit.at(u, v) == 0) continue;
      const Vec3 p = view.frame.T_world_camera *
                     (double{view.frame.depth.at(u, v)} * view.frame.intrinsics.ray(u, v));
      const PixelLabel truth = p.y() > -0.07 ? PixelLabel::turning_fruit : PixelLabel::ripe_fruit;
      right += detection->label.at(u, v) == truth;
      ++all;
    }
  }
  EXPECT_GT(right, 0.95 * all);
}

TEST(LabelDetector, TakesCleanLabelsAsTheyAre) {
  const View view = plant();
  const PixelScore clean = score(LabelDetector(), view);
  EXPECT_EQ(clean.precision, 1.0);
  EXPECT_EQ(clean.recall, 1.0);
}

TEST(LabelDetector, OutvotesLabelsThatAreRightWithProbabilityPointSeven) {
  View view = plant();
  Rng rng(1);
  for (PixelLabel& label : view.frame.labels.pixels()) {
    if (!rng.chance(0.3)) continue;
    label = label == PixelLabel::background ? PixelLabel::ripe_fruit : PixelLabel::background;
  }
  const double raw = score(LabelDetector(), view).iou;
  LabelDetectorOptions options;
  options.majority_radius_px = 3;
  const double voted = score(LabelDetector(options), view).iou;
  EXPECT_LT(raw, 0.3);
  EXPECT_GT(voted, 0.8);
}

TEST(LabelDetector, RefusesFramesWithoutLabels) {
  View view = plant();
  view.frame.labels = {};
  const auto detection = LabelDetector().detect(view.frame);
  ASSERT_FALSE(detection.has_value());
  EXPECT_NE(detection.error().message.find("labels"), std::string::npos);
}

TEST(NetworkDetector, RunsAModelFromFileToPixels) {
  const auto detector = NetworkDetector::make(colour_rule());
  ASSERT_TRUE(detector.has_value()) << detector.error().message;
  const View view = plant();
  const PixelScore found = score(**detector, view);
  EXPECT_GT(found.precision, 0.95);
  EXPECT_GT(found.recall, 0.8);
}

TEST(NetworkDetector, ScalesImagesToTheModelsSize) {
  NetworkDetectorOptions options = colour_rule();
  options.input_width_px = 160;
  options.input_height_px = 120;
  const auto detector = NetworkDetector::make(options);
  ASSERT_TRUE(detector.has_value()) << detector.error().message;
  EXPECT_GT(score(**detector, plant()).iou, 0.7);
}

TEST(NetworkDetector, SaysWhatIsWrongWithAModel) {
  const auto message = [](const NetworkDetectorOptions& options) {
    const auto detector = NetworkDetector::make(options);
    EXPECT_FALSE(detector.has_value());
    return detector ? std::string() : detector.error().message;
  };
  NetworkDetectorOptions missing = colour_rule();
  missing.model = "/nowhere/model.onnx";
  EXPECT_NE(message(missing).find("/nowhere/model.onnx: no such model file"), std::string::npos);

  NetworkDetectorOptions none = colour_rule();
  none.model = std::filesystem::temp_directory_path() / "SaysWhatIsWrongWithAModel_canopeer.onnx";
  std::ofstream(none.model) << "this is no model";
  EXPECT_NE(message(none).find("not an ONNX model"), std::string::npos);
  std::filesystem::remove(none.model);

  NetworkDetectorOptions channels = colour_rule();
  channels.model = kModels / "four_channels.onnx";
  EXPECT_NE(message(channels).find("cannot take an input of 1 x 3 x 240 x 320"), std::string::npos);

  NetworkDetectorOptions classes = colour_rule();
  classes.classes = {PixelLabel::background, PixelLabel::ripe_fruit};
  EXPECT_NE(message(classes).find("expected 1 x 2 x"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
