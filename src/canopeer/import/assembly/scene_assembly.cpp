#include "canopeer/import/assembly/scene_assembly.h"

#include <algorithm>
#include <map>
#include <set>

namespace canopeer {
namespace {

ScenePart to_part(MeshPiece piece, PartClass kind, int plant, int fruit) {
  ScenePart part;
  if (piece.mesh.normals.empty()) compute_normals(piece.mesh);
  part.mesh = std::move(piece.mesh);
  part.kind = kind;
  part.plant = plant;
  part.fruit = fruit;
  part.color = piece.color;
  part.vertex_colors = std::move(piece.vertex_colors);
  part.texture = std::move(piece.texture);
  part.uv = std::move(piece.uv);
  part.see_through = piece.see_through;
  return part;
}

/// The fruit surfaces of one model.
struct FruitSurfaces {
  std::vector<MeshPiece> pieces;
  std::vector<bool> counted;  ///< per piece
};

FruitTruth truth_of(const FruitComponents::Component& component, const std::string& model, int id,
                    int plant) {
  FruitTruth fruit;
  fruit.id = id;
  fruit.centre = component.hull.centroid;
  const FruitSize size = measure_fruit(component.hull);
  fruit.length_m = size.length_m;
  fruit.diameter_m = size.diameter_m;
  fruit.volume_cm3 = component.hull.volume_m3 * 1e6;
  fruit.surface_cm2 = component.surface_m2 * 1e4;
  fruit.plant = plant;
  fruit.model = model;
  return fruit;
}

/// Splits a model's fruit surfaces into fruits; scraps become distractors.
int add_fruits(const std::string& model, int plant, const FruitSurfaces& surfaces,
               const FruitComponentOptions& options, Scene* scene) {
  const FruitComponents found = find_fruits(surfaces.pieces, options);
  const int first = static_cast<int>(scene->fruits.size());
  for (const auto& component : found.components) {
    scene->fruits.push_back(
        truth_of(component, model, static_cast<int>(scene->fruits.size()), plant));
    scene->fruits.back().counted = false;
  }
  for (std::size_t i = 0; i < surfaces.pieces.size(); ++i) {
    const std::set<int> here(found.component_of[i].begin(), found.component_of[i].end());
    for (const int component : here) {
      MeshPiece piece = selected(surfaces.pieces[i], found.component_of[i], component);
      const int fruit = component < 0 ? -1 : first + component;
      scene->parts.push_back(to_part(std::move(piece),
                                     component < 0 ? PartClass::distractor : PartClass::fruit,
                                     plant, fruit));
      if (fruit >= 0 && surfaces.counted[i]) {
        scene->fruits[static_cast<std::size_t>(fruit)].counted = true;
      }
    }
  }
  for (std::size_t i = static_cast<std::size_t>(first); i < scene->fruits.size(); ++i) {
    // What counts is what a run should find: ripe by name if not by colour.
    scene->fruits[i].ripeness = scene->fruits[i].counted ? Ripeness::ripe : Ripeness::green;
  }
  return found.scraps;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
  return text;
}

std::vector<PartsRow> parts_table(const std::vector<ClassifiedPiece>& pieces) {
  std::map<std::vector<std::string>, PartsRow> rows;
  for (const ClassifiedPiece& p : pieces) {
    const PartNames& n = p.piece.names;
    PartsRow& row = rows[{n.file, n.mesh, n.node, n.material, joined(n.textures), n.visual,
                          part_class_name(p.kind), p.counted ? "1" : "0"}];
    if (row.pieces == 0) row.names = n;
    row.kind = p.kind;
    row.counted = p.kind == PartClass::fruit && p.counted;
    ++row.pieces;
    row.triangles += p.piece.mesh.triangles.size();
  }
  std::vector<PartsRow> table;
  for (auto& [key, row] : rows) table.push_back(std::move(row));
  return table;
}

}  // namespace

std::vector<ClassifiedPiece> classify(std::vector<MeshPiece> pieces, const NamePatterns& patterns) {
  std::vector<std::optional<PartClass>> kinds;
  std::set<std::string> plants;
  for (const MeshPiece& piece : pieces) {
    kinds.push_back(patterns.class_of(piece.names));
    if (kinds.back() || patterns.plant(piece.names)) plants.insert(piece.names.model);
  }
  const PartClass rest = patterns.options().stem.empty() ? PartClass::stem : PartClass::structure;
  std::vector<ClassifiedPiece> result;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (patterns.skip(pieces[i].names)) continue;
    ClassifiedPiece classified;
    classified.plant = plants.count(pieces[i].names.model) != 0;
    classified.kind = kinds[i].value_or(classified.plant ? rest : PartClass::structure);
    classified.counted = patterns.counted(pieces[i].names);
    classified.piece = std::move(pieces[i]);
    result.push_back(std::move(classified));
  }
  return result;
}

ImportedScene assemble_scene(std::string name, std::vector<ClassifiedPiece> pieces,
                             const FruitComponentOptions& options) {
  ImportedScene result;
  result.scene.name = std::move(name);
  result.scene.imported = true;
  result.parts = parts_table(pieces);
  std::map<std::string, int> plants;
  std::vector<std::string> order;
  std::map<std::string, FruitSurfaces> fruits;
  for (ClassifiedPiece& p : pieces) {
    const std::string model = p.piece.names.model;
    int plant = -1;
    if (p.plant) {
      plant = plants.emplace(model, static_cast<int>(plants.size())).first->second;
    }
    if (p.kind != PartClass::fruit) {
      result.scene.parts.push_back(to_part(std::move(p.piece), p.kind, plant, -1));
      continue;
    }
    if (fruits.count(model) == 0) order.push_back(model);
    fruits[model].pieces.push_back(std::move(p.piece));
    fruits[model].counted.push_back(p.counted);
  }
  int scraps = 0;
  for (const std::string& model : order) {
    scraps += add_fruits(model, plants.at(model), fruits[model], options, &result.scene);
  }
  if (scraps > 0) {
    result.notices.push_back(
        std::to_string(scraps) +
        " scraps of fruit surface are too small to be fruits and do not count");
  }
  return result;
}

std::string parts_csv(const ImportedScene& scene) {
  const auto word = [](std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20; }, '_');
    return text;
  };
  std::string csv =
      "material,textures,mesh,node,file,visual,model,class,counted,pieces,triangles\n";
  for (const PartsRow& row : scene.parts) {
    const PartNames& n = row.names;
    for (const std::string& name :
         {n.material, joined(n.textures), n.mesh, n.node, n.file, n.visual, n.model}) {
      csv += word(name) + ",";
    }
    csv += std::string(part_class_name(row.kind)) + "," + (row.counted ? "1" : "0") + "," +
           std::to_string(row.pieces) + "," + std::to_string(row.triangles) + "\n";
  }
  return csv;
}

}  // namespace canopeer
