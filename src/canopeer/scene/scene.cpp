#include "canopeer/scene/scene.h"

#include <algorithm>
#include <set>

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
    case PartClass::support:
      return "support";
  }
  CANOPEER_CHECK(false, "unknown part class");
}

int Scene::counted_fruits() const {
  return static_cast<int>(
      std::count_if(fruits.begin(), fruits.end(), [](const FruitTruth& f) { return f.counted; }));
}

Box Scene::bounds(bool plants_only) const {
  Box box;
  for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
    if (!plants_only || part.plant >= 0) box.extend(transformed(part.mesh.bounds(), T));
  });
  return box;
}

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for_each_part([&](const ScenePart& part, const Pose&, const SceneInstance*) {
    count += part.mesh.triangles.size();
  });
  return count;
}

double Scene::leaf_area() const {
  double area = 0.0;
  for_each_part([&](const ScenePart& part, const Pose&, const SceneInstance*) {
    if (part.kind == PartClass::leaf) area += part.mesh.area();
  });
  return area;
}

int Scene::plant_count() const {
  std::set<int> plants;
  for (const ScenePart& part : parts) {
    if (part.plant >= 0) plants.insert(part.plant);
  }
  return static_cast<int>(plants.size() + instances.size());
}

}  // namespace canopeer
