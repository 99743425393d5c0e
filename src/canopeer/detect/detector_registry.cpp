#include "canopeer/detect/detector_registry.h"

#include <utility>

namespace canopeer {
namespace {

using Made = Expected<std::unique_ptr<Detector>>;

template <typename D, typename Options>
Made with_valid(const Options& options) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  return std::make_unique<D>(options);
}

}  // namespace

DetectorRegistry DetectorRegistry::built_in() {
  DetectorRegistry all;
  all.put("colour", "fruit-coloured blobs",
          [](const DetectorOptions& o) { return with_valid<ColorDetector>(o.colour); });
  all.put("labels", "the labels that come with the frames",
          [](const DetectorOptions& o) { return with_valid<LabelDetector>(o.labels); });
  all.put("network", "a segmentation network, from an ONNX file",
          [](const DetectorOptions& o) -> Made { return NetworkDetector::make(o.network); });
  return all;
}

Expected<std::unique_ptr<Detector>> DetectorRegistry::make(const DetectorOptions& options) const {
  const auto factory = find(options.kind);
  if (!factory) return tl::unexpected(factory.error());
  auto detector = (*factory)(options);
  if (detector && *detector == nullptr) {
    return fail("detector '" + options.kind + "': its factory made none");
  }
  return detector;
}

}  // namespace canopeer
