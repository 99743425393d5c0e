#include "canopeer/scene/scene_hash.h"

#include <bit>

namespace canopeer {
namespace {

class Fnv {
 public:
  void add(std::uint64_t x) { hash_ = (hash_ ^ x) * 0x100000001b3ULL; }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(Rgb c) { add(static_cast<std::uint64_t>(c.r * 65536 + c.g * 256 + c.b)); }
  void add(const ScenePart& part) {
    for (const auto& v : part.mesh.vertices) {
      for (int i = 0; i < 3; ++i) add(std::uint64_t{std::bit_cast<std::uint32_t>(v[i])});
    }
    for (const auto& t : part.mesh.triangles) {
      for (const std::uint32_t i : t) add(std::uint64_t{i});
    }
    add(part.color);
    for (const Rgb& c : part.vertex_colors) add(c);
    add(static_cast<std::uint64_t>(part.kind));
    add(static_cast<std::uint64_t>(part.plant));
    add(static_cast<std::uint64_t>(part.fruit));
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t scene_hash(const Scene& scene) {
  Fnv fnv;
  for (const ScenePart& part : scene.parts) fnv.add(part);
  for (const SceneModel& model : scene.models) {
    for (const ScenePart& part : model.parts) fnv.add(part);
  }
  for (const SceneInstance& copy : scene.instances) {
    fnv.add(std::uint64_t{copy.model});
    for (int i = 0; i < 16; ++i) fnv.add(copy.T_world_model.data()[i]);
    fnv.add(std::uint64_t{std::bit_cast<std::uint32_t>(copy.brightness)});
  }
  for (const FruitTruth& fruit : scene.fruits) {
    for (int i = 0; i < 3; ++i) fnv.add(fruit.centre[i]);
    fnv.add(fruit.volume_cm3);
    fnv.add(static_cast<std::uint64_t>(fruit.ripeness));
  }
  return fnv.value();
}

}  // namespace canopeer
