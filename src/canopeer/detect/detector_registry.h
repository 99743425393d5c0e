#pragma once

#include <memory>
#include <string>
#include <vector>

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
};

/// Names of all detectors: colour, labels, network.
[[nodiscard]] const std::vector<std::string>& detector_names();

/// The error names what is wrong: an unknown name, an option, the network's file.
[[nodiscard]] Expected<std::unique_ptr<Detector>> make_detector(const DetectorOptions& options);

}  // namespace canopeer
