#include "canopeer/report/reading/killed_run.h"

#include <cmath>
#include <numbers>

#include "canopeer/record/fruit_course.h"

namespace canopeer {

Summary summary_from_record(const RunRecord& record) {
  Summary s = summary_of(record);
  s.interrupted = true;
  return s;
}

std::vector<FruitEstimate> fruits_from_record(const RunRecord& record) {
  std::vector<FruitEstimate> fruits;
  const std::vector<FruitsAtTime> course = fruit_course(record);
  if (course.empty()) return fruits;
  for (const FruitSnapshot& snapshot : *course.back().fruits) {
    FruitEstimate fruit;
    fruit.id = snapshot.id;
    fruit.centre = snapshot.centre;
    fruit.volume_cm3 = snapshot.volume_cm3;
    const double radius_m = std::cbrt(0.75e-6 * snapshot.volume_cm3 / std::numbers::pi);
    fruit.semi_axes_m.setConstant(radius_m);
    fruits.push_back(fruit);
  }
  return fruits;
}

}  // namespace canopeer
