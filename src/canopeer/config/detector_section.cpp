#include "canopeer/config/detector_section.h"

#include <algorithm>
#include <string>

namespace canopeer {
namespace {

PixelLabel label_named(const std::string& name) {
  if (name == "green") return PixelLabel::green_fruit;
  if (name == "turning") return PixelLabel::turning_fruit;
  if (name == "ripe") return PixelLabel::ripe_fruit;
  return PixelLabel::background;
}

void read_colour(YamlMap& detector, ColorDetectorOptions& o) {
  if (detector.has("windows")) o.windows.clear();
  for (YamlMap& map : detector.maps("windows")) {
    ColorWindow window;
    window.label = label_named(map.choice("ripeness", "ripe", {"green", "turning", "ripe"}));
    window.hue_low_deg = map.required_number("hue_low_deg", {-180.0, 180.0});
    window.hue_high_deg = map.required_number("hue_high_deg", {-180.0, 180.0});
    window.min_saturation = map.number("min_saturation", window.min_saturation, {0.0, 1.0});
    window.min_value = map.number("min_value", window.min_value, {0.0, 1.0});
    window.min_saturation_at_fruit =
        map.number("min_saturation_at_fruit",
                   std::min(window.min_saturation, window.min_saturation_at_fruit), {0.0, 1.0});
    o.windows.push_back(window);
  }
  o.opening_radius_px = detector.integer("opening_radius_px", o.opening_radius_px, 0, 20);
  o.closing_radius_px = detector.integer("closing_radius_px", o.closing_radius_px, 0, 20);
  o.min_blob_px = detector.integer("min_blob_px", o.min_blob_px, 0, 1000000);
  o.min_blob_area_cm2 = detector.number("min_blob_area_cm2", o.min_blob_area_cm2, {0.0, 1e4});
  o.depth_step_m = detector.number("depth_step_m", o.depth_step_m, {0.0001, 10.0});
  if (auto ok = o.validate(); !ok) detector.complain("windows", ok.error().message);
}

void read_labels(YamlMap& detector, LabelDetectorOptions& o) {
  o.majority_radius_px = detector.integer("majority_radius_px", o.majority_radius_px, 0, 10);
}

void read_network(YamlMap& detector, const std::filesystem::path& directory,
                  NetworkDetectorOptions& o) {
  const std::filesystem::path model = detector.required_text("model");
  o.model = model.is_absolute() ? model : directory / model;
  o.input_width_px = detector.integer("input_width_px", o.input_width_px, 32, 8192);
  o.input_height_px = detector.integer("input_height_px", o.input_height_px, 32, 8192);
  o.scale = detector.number("scale", o.scale, {1e-9, 1e9});
  o.mean = detector.numbers("mean", o.mean, 3);
  o.bgr = detector.boolean("bgr", o.bgr);
  o.softmax = detector.boolean("softmax", o.softmax);
  o.min_confidence = detector.number("min_confidence", o.min_confidence, {0.0, 1.0});
  const std::vector<std::string> names =
      detector.texts("classes", {"background", "turning", "ripe"});
  o.classes.clear();
  for (const std::string& name : names) {
    const PixelLabel label = label_named(name);
    if (label == PixelLabel::background && name != "background") {
      detector.complain("classes",
                        "expected background, green, turning or ripe, found '" + name + "'");
    }
    o.classes.push_back(label);
  }
}

}  // namespace

void read_detector(YamlMap detector, const std::filesystem::path& directory,
                   const std::vector<std::string>& kinds, DetectorOptions& o) {
  o.kind = detector.choice("kind", o.kind, kinds);
  if (o.kind == "colour") read_colour(detector, o.colour);
  if (o.kind == "labels") read_labels(detector, o.labels);
  if (o.kind == "network") read_network(detector, directory, o.network);
}

}  // namespace canopeer
