#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/geometry/triangle_mesh.h"
#include "canopeer/scene/fruit_truth.h"
#include "canopeer/scene/texture.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What a surface belongs to. `structure` is what stands for good (floor, walls, slabs);
/// `distractor` is whatever a colour detector may take for a fruit; `support` are strings, which
/// nobody knows in advance.
enum class PartClass : std::uint8_t { leaf, stem, fruit, calyx, structure, distractor, support };

/// "leaf", "stem", …
const char* part_class_name(PartClass kind);

/// One piece of one material. Leaves are single sheets seen from both sides; fruits are closed.
struct ScenePart {
  TriangleMesh mesh;  ///< world frame, with normals
  PartClass kind = PartClass::structure;
  int plant = -1;                          ///< index of the plant in the scene, −1: none
  int fruit = -1;                          ///< FruitTruth::id for the body of a fruit, else −1
  Rgb color;                               ///< base colour, before light
  std::vector<Rgb> vertex_colors;          ///< one per vertex, in place of `color`; mostly empty
  std::shared_ptr<const Texture> texture;  ///< in place of both; null: none
  std::vector<Eigen::Vector2f> uv;         ///< one per vertex when there is a texture
  bool see_through = false;  ///< glass and the like: no camera sees it, but it is in the way

  /// Floor, walls and the like: what a robot knows in advance and must never touch.
  [[nodiscard]] bool static_structure() const { return kind == PartClass::structure; }
};

/// Parts that stand in a scene many times, in a frame of their own: ScenePart::plant is 0,
/// ScenePart::fruit counts from 0.
struct SceneModel {
  std::vector<ScenePart> parts;
};

/// One of them in its place.
struct SceneInstance {
  std::size_t model = 0;  ///< index into Scene::models
  Pose T_world_model = Pose::Identity();
  int plant = -1;           ///< index of the plant in the scene
  int first_fruit = 0;      ///< FruitTruth::id of the model's fruit 0
  float brightness = 1.0F;  ///< all its colours times this: no two plants look quite the same
};

/// A world at rest with its ground truth. z up, floor at z = 0.
struct Scene {
  std::string name;
  std::uint64_t seed = 0;
  bool imported = false;  ///< made of files people had: fruit volumes are those of convex hulls
  std::vector<ScenePart> parts;
  std::vector<SceneModel> models;  ///< of long rows, whose plants are copies
  std::vector<SceneInstance> instances;
  std::vector<FruitTruth> fruits;  ///< fruits[i].id == i
  double ground_m2 = 0.0;          ///< that the plants share; 0: not known

  /// Ripe or turning fruits: the ones a run is scored on.
  [[nodiscard]] int counted_fruits() const;
  /// Around all parts, or around the plants only; world.
  [[nodiscard]] Box bounds(bool plants_only = false) const;
  [[nodiscard]] std::size_t triangle_count() const;
  /// One-sided area of all leaves, m².
  [[nodiscard]] double leaf_area() const;
  [[nodiscard]] int plant_count() const;

  /// Calls visit(part, T_world_part, instance) for every part, copies too; `instance` is null for
  /// those of the scene itself, whose pose is the identity.
  template <typename Visit>
  void for_each_part(const Visit& visit) const {
    for (const ScenePart& part : parts) {
      visit(part, Pose(Pose::Identity()), static_cast<const SceneInstance*>(nullptr));
    }
    for (const SceneInstance& instance : instances) {
      for (const ScenePart& part : models[instance.model].parts) {
        visit(part, instance.T_world_model, &instance);
      }
    }
  }
};

}  // namespace canopeer
