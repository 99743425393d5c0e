#include "canopeer/detect/detector_registry.h"

namespace canopeer {

const std::vector<std::string>& detector_names() {
  static const std::vector<std::string> names = {"colour", "labels", "network"};
  return names;
}

Expected<std::unique_ptr<Detector>> make_detector(const DetectorOptions& options) {
  if (options.kind == "colour") {
    if (auto ok = options.colour.validate(); !ok) return tl::unexpected(ok.error());
    return std::make_unique<ColorDetector>(options.colour);
  }
  if (options.kind == "labels") {
    if (auto ok = options.labels.validate(); !ok) return tl::unexpected(ok.error());
    return std::make_unique<LabelDetector>(options.labels);
  }
  if (options.kind == "network") {
    auto network = NetworkDetector::make(options.network);
    if (!network) return tl::unexpected(network.error());
    return std::unique_ptr<Detector>(std::move(*network));
  }
  return fail("unknown detector '" + options.kind + "'; there are colour, labels, network");
}

}  // namespace canopeer
