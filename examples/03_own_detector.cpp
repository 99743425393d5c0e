// A fruit detector of your own in a mission: which pixels are fruit, and how sure that is.
//   03_own_detector missions/smoke.yaml out/own_detector

#include <cstdio>

#include "canopeer/run/run.h"

using namespace canopeer;

namespace {

/// Fruit is what is much redder than green.
class RednessDetector : public Detector {
 public:
  explicit RednessDetector(double least) : least_(least) {}

  Expected<Detection> detect(const RgbdFrame& frame) const override {
    const int width = frame.color.width();
    const int height = frame.color.height();
    Detection found{Image<PixelLabel>(width, height), Mask(width, height),
                    Image<float>(width, height)};
    for (std::size_t i = 0; i < found.label.pixels().size(); ++i) {
      const Rgb& pixel = frame.color.pixels()[i];
      const double redness = (pixel.r - pixel.g) / 255.0;
      if (redness < least_ || !(frame.depth.pixels()[i] > 0.0F)) continue;
      found.label.pixels()[i] = PixelLabel::ripe_fruit;
      found.fruit.pixels()[i] = static_cast<std::uint8_t>(PixelLabel::ripe_fruit);
      found.confidence.pixels()[i] = static_cast<float>(redness);
    }
    return found;
  }

 private:
  double least_;
};

Expected<std::unique_ptr<Detector>> make_redness(const DetectorOptions& options) {
  const auto least = options.own.find("least");
  return std::make_unique<RednessDetector>(
      least == options.own.end() ? 0.25 : std::atof(least->second.c_str()));
}

int complain(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return complain({"usage: 03_own_detector MISSION OUT"});
  RunRegistries registries = RunRegistries::built_in();
  if (auto ok = registries.detectors.add("redness", "redder than green", make_redness); !ok) {
    return complain(ok.error());
  }
  StageRequest request;
  request.mission = argv[1];
  request.overrides = {{"detector.kind", "redness"}, {"own_detector.least", "0.2"}};
  request.table_dirs = {request.mission.parent_path() / "../compute_tables"};
  const auto run = Run::compose(request, registries, argv[2]);
  if (!run) return complain(run.error());
  const auto summary = (*run)->execute();
  if (!summary) return complain(summary.error());
  std::printf("of the pixels it found %.0f %% are fruit, of fruit pixels it found %.0f %%\n",
              100.0 * summary->pixel_precision.value_or(0.0),
              100.0 * summary->pixel_recall.value_or(0.0));
  std::printf("%d of %d fruits found\n", summary->detected.value_or(0),
              summary->fruits_total.value_or(0));
  return 0;
}
