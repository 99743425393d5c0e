#include "canopeer/scene/ground_truth_csv.h"

#include <fmt/format.h>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

const char* class_name(Ripeness ripeness) {
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

}  // namespace

std::string ground_truth_csv(const Scene& scene) {
  std::string csv =
      "id,class,counted,x_m,y_m,z_m,length_m,diameter_m,volume_cm3,surface_cm2,plant\n";
  for (const FruitTruth& f : scene.fruits) {
    csv +=
        fmt::format("{},{},{},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{:.2f},{:.2f},{}\n", f.id,
                    class_name(f.ripeness), f.counted ? 1 : 0, f.centre.x(), f.centre.y(),
                    f.centre.z(), f.length_m, f.diameter_m, f.volume_cm3, f.surface_cm2, f.plant);
  }
  return csv;
}

}  // namespace canopeer
