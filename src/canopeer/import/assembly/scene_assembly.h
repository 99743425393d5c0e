#pragma once

#include <functional>
#include <string>
#include <vector>

#include "canopeer/import/assembly/fruit_components.h"
#include "canopeer/import/assembly/name_patterns.h"

namespace canopeer {

/// A piece of the world in its place, and what it is.
struct ClassifiedPiece {
  MeshPiece piece;  ///< world frame; names.model says which model
  PartClass kind = PartClass::structure;
  bool counted = true;  ///< fruits only
  bool plant = false;   ///< belongs to a plant
};

/// What became of the names in a world: one row for each combination that occurs.
struct PartsRow {
  PartNames names;
  PartClass kind = PartClass::structure;
  bool counted = false;
  int pieces = 0;
  std::size_t triangles = 0;
};

/// A world that was read: its scene, what each part was taken for, what was left out.
struct ImportedScene {
  Scene scene;
  std::vector<PartsRow> parts;
  std::vector<std::string> notices;  ///< what is missing or left out; the run can go on
};

/// Makes a scene of pieces: fruits are the connected components of each model's fruit triangles.
/// Models that have a leaf, stem or fruit are plants.
[[nodiscard]] ImportedScene assemble_scene(std::string name, std::vector<ClassifiedPiece> pieces,
                                           const FruitComponentOptions& options);

/// Classifies by names. A part of a plant that no pattern matches is stem when there is no pattern
/// for stems, else structure.
[[nodiscard]] std::vector<ClassifiedPiece> classify(std::vector<MeshPiece> pieces,
                                                    const NamePatterns& patterns);

/// `material,textures,mesh,node,file,visual,model,class,counted,pieces,triangles`, one row for each
/// combination of names; `model` is the first it occurs in. To find patterns with.
[[nodiscard]] std::string parts_csv(const ImportedScene& scene);

}  // namespace canopeer
