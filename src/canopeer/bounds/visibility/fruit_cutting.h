#pragma once

#include <vector>

#include "canopeer/bounds/view_pool.h"
#include "canopeer/render/numbered_view.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// The counted fruits' bodies, world, each triangle with the number of its patch.
struct CutFruits {
  FruitPatches patches;
  std::vector<std::vector<Vec3>> points;  ///< by patch: the middles of its triangles, world
  std::vector<NumberedPart> bodies;
};

/// Triangles with an edge longer than `patch_m` are halved first. Then seeds are taken on each
/// body, always the triangle farthest from all seeds so far, until none is farther than ¾ patch_m
/// (farthest-point sampling, Gonzalez 1985). Each triangle belongs to its nearest seed.
[[nodiscard]] CutFruits cut_fruits(const Scene& scene, double patch_m);

/// What else is solid or opaque within the box: all parts but those bodies, triangles outside left
/// out; world. Nothing in it has a number.
[[nodiscard]] std::vector<NumberedPart> what_else_is_near(const Scene& scene, const Box& box_world);

}  // namespace canopeer
