#include "canopeer/scene/ground_truth_json.h"

#include <fmt/format.h>

#include "canopeer/scene/ground_truth_csv.h"

namespace canopeer {
namespace {

/// As a JSON string; bytes that are no ASCII stay as they are.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string fruit_json(const Scene& scene, const FruitTruth& f) {
  std::string text = fmt::format(
      "{{\"id\": {}, \"class\": \"{}\", \"counted\": {}, \"x_m\": {:.5f}, \"y_m\": {:.5f}, "
      "\"z_m\": {:.5f}, \"length_m\": {:.4f}, \"diameter_m\": {:.4f}, \"{}\": {:.2f}, "
      "\"surface_cm2\": {:.2f}, ",
      f.id, ripeness_name(f.ripeness), f.counted, f.centre.x(), f.centre.y(), f.centre.z(),
      f.length_m, f.diameter_m, scene.imported ? "hull_volume_cm3" : "volume_cm3", f.volume_cm3,
      f.surface_cm2);
  return text +
         (scene.imported ? "\"model\": " + quoted(f.model)
                         : fmt::format("\"plant\": {}", f.plant)) +
         "}";
}

}  // namespace

std::string ground_truth_json(const Scene& scene) {
  std::string json = fmt::format(
      "{{\n  \"name\": {},\n  \"seed\": {},\n  \"imported\": {},\n  \"fruits_counted\": {},\n"
      "  \"fruits\": [",
      quoted(scene.name), scene.seed, scene.imported, scene.counted_fruits());
  for (std::size_t i = 0; i < scene.fruits.size(); ++i) {
    json += (i == 0 ? "\n    " : ",\n    ") + fruit_json(scene, scene.fruits[i]);
  }
  return json + (scene.fruits.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace canopeer
