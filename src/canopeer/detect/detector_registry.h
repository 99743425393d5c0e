#pragma once

#include <map>
#include <memory>
#include <string>

#include "canopeer/base/named_factories.h"
#include "canopeer/detect/color_detector.h"
#include "canopeer/detect/label_detector.h"
#include "canopeer/detect/network_detector.h"

namespace canopeer {

/// Which detector, and the options of each.
struct DetectorOptions {
  std::string kind = "colour";
  ColorDetectorOptions colour;
  LabelDetectorOptions labels;
  NetworkDetectorOptions network;
  /// Of detectors registered from outside, as the mission's section `own_detector` has them.
  std::map<std::string, std::string> own;
};

/// The detectors there are to choose from, by name. Whoever has a detector of his own adds it:
///
///     DetectorRegistry detectors = DetectorRegistry::built_in();
///     auto ok = detectors.add("yolo", "YOLO on a GPU", [](const DetectorOptions& options) {
///       return YoloDetector::make(options.own);
///     });
///
/// A factory's error says what of its options is wrong.
class DetectorRegistry
    : public NamedFactories<Expected<std::unique_ptr<Detector>>(const DetectorOptions&)> {
 public:
  /// Those of this library: colour, labels, network.
  [[nodiscard]] static DetectorRegistry built_in();

  /// The detector `options.kind`. The error names what is wrong: an unknown name (it lists those
  /// there are), an option, the network's file.
  [[nodiscard]] Expected<std::unique_ptr<Detector>> make(const DetectorOptions& options) const;

 private:
  DetectorRegistry() : NamedFactories("detector") {}
};

}  // namespace canopeer
