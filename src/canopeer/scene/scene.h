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
/// `distractor` is whatever a colour detector may take for a fruit.
enum class PartClass : std::uint8_t { leaf, stem, fruit, calyx, structure, distractor };

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

/// A world at rest with its ground truth. z up, floor at z = 0.
struct Scene {
  std::string name;
  std::uint64_t seed = 0;
  bool imported = false;  ///< made of files people had: fruit volumes are those of convex hulls
  std::vector<ScenePart> parts;
  std::vector<FruitTruth> fruits;  ///< fruits[i].id == i

  /// Ripe or turning fruits: the ones a run is scored on.
  [[nodiscard]] int counted_fruits() const;
  /// Around all parts, or around the plants only; world.
  [[nodiscard]] Box bounds(bool plants_only = false) const;
  [[nodiscard]] std::size_t triangle_count() const;
};

}  // namespace canopeer
