#include "canopeer/detect/detector_registry.h"

#include <utility>

#include "canopeer/base/check.h"

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
  const auto add = [&](const char* name, const char* one_line, Factory factory) {
    const auto added = all.add(name, one_line, std::move(factory));
    CANOPEER_CHECK(added.has_value(), "built-in names are good and differ");
  };
  add("colour", "fruit-coloured blobs",
      [](const DetectorOptions& o) { return with_valid<ColorDetector>(o.colour); });
  add("labels", "the labels that come with the frames",
      [](const DetectorOptions& o) { return with_valid<LabelDetector>(o.labels); });
  add("network", "a segmentation network, from an ONNX file",
      [](const DetectorOptions& o) -> Made { return NetworkDetector::make(o.network); });
  return all;
}

Expected<std::unique_ptr<Detector>> DetectorRegistry::make(const DetectorOptions& options) const {
  const auto factory = find(options.kind);
  if (!factory) return tl::unexpected(factory.error());
  auto detector = (*factory)(options);
  if (detector) CANOPEER_CHECK(*detector != nullptr, "a factory gives a detector or an error");
  return detector;
}

}  // namespace canopeer
