#include "canopeer/scene/scene.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {

const char* part_class_name(PartClass kind) {
  switch (kind) {
    case PartClass::leaf:
      return "leaf";
    case PartClass::stem:
      return "stem";
    case PartClass::fruit:
      return "fruit";
    case PartClass::calyx:
      return "calyx";
    case PartClass::structure:
      return "structure";
    case PartClass::distractor:
      return "distractor";
  }
  CANOPEER_CHECK(false, "unknown part class");
}

int Scene::counted_fruits() const {
  return static_cast<int>(
      std::count_if(fruits.begin(), fruits.end(), [](const FruitTruth& f) { return f.counted; }));
}

Box Scene::bounds(bool plants_only) const {
  Box box;
  for (const ScenePart& part : parts) {
    if (!plants_only || part.plant >= 0) box.extend(part.mesh.bounds());
  }
  return box;
}

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const ScenePart& part : parts) count += part.mesh.triangles.size();
  return count;
}

}  // namespace canopeer
