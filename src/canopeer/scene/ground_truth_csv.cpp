#include "canopeer/scene/ground_truth_csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

/// As one field of a CSV file without quoting.
std::string csv_word(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20; }, '_');
  return text;
}

}  // namespace

const char* ripeness_name(Ripeness ripeness) {
  switch (ripeness) {
    case Ripeness::green:
      return "green";
    case Ripeness::turning:
      return "turning";
    case Ripeness::ripe:
      return "ripe";
  }
  CANOPEER_CHECK(false, "unknown ripeness");
}

std::string ground_truth_csv(const Scene& scene) {
  std::string csv = fmt::format(
      "id,class,counted,x_m,y_m,z_m,length_m,diameter_m,{},surface_cm2,{}\n",
      scene.imported ? "hull_volume_cm3" : "volume_cm3", scene.imported ? "model" : "plant");
  for (const FruitTruth& f : scene.fruits) {
    csv += fmt::format("{},{},{},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{:.2f},{:.2f},{}\n", f.id,
                       ripeness_name(f.ripeness), f.counted ? 1 : 0, f.centre.x(), f.centre.y(),
                       f.centre.z(), f.length_m, f.diameter_m, f.volume_cm3, f.surface_cm2,
                       scene.imported ? csv_word(f.model) : std::to_string(f.plant));
  }
  return csv;
}

}  // namespace canopeer
