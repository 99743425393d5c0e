#include "canopeer/import/scan_rows.h"

#include <algorithm>
#include <cmath>

#include "canopeer/import/mesh_file.h"
#include "canopeer/import/shape_mesh.h"

namespace canopeer {
namespace {

constexpr double kFootHeight = 0.03;  // of a plant: where its stem meets the ground
constexpr double kMargin = 3.0;       // of the floor around the plants

/// Colour a scan shows at a vertex.
Rgb color_at(const MeshPiece& piece, std::uint32_t vertex) {
  if (piece.texture != nullptr && !piece.texture->color.empty()) {
    const Eigen::Vector3f c = piece.texture->color_at(piece.uv[vertex]);
    return {static_cast<std::uint8_t>(c.x()), static_cast<std::uint8_t>(c.y()),
            static_cast<std::uint8_t>(c.z())};
  }
  return piece.vertex_colors.empty() ? piece.color : piece.vertex_colors[vertex];
}

/// 1 for the triangles with at least two corners of the colour: single odd vertices of a scan do
/// not count.
std::vector<int> triangles_of_color(const MeshPiece& piece, const ColorRange& range) {
  std::vector<bool> held(piece.mesh.vertices.size());
  for (std::uint32_t i = 0; i < held.size(); ++i) held[i] = range.holds(color_at(piece, i));
  std::vector<int> result;
  for (const auto& t : piece.mesh.triangles) {
    result.push_back(int{held[t[0]]} + int{held[t[1]]} + int{held[t[2]]} >= 2 ? 1 : 0);
  }
  return result;
}

/// The frame of a scan's file to that of the plant, foot at the origin.
Eigen::Affine3d plant_frame(const PlantScan& scan, const std::vector<ClassifiedPiece>& pieces) {
  Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  if (scan.y_up) upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Affine3d T(scan.unit_m * upright);
  if (!scan.ground) return T;
  Box box;
  for (const auto& p : pieces) {
    for (const auto& v : p.piece.mesh.vertices) box.extend(T * v.cast<double>());
  }
  if (box.isEmpty()) return T;
  Box foot;
  const double top = box.min().z() + std::max(kFootHeight * box.sizes().z(), 0.01);
  for (const auto& p : pieces) {
    for (const auto& v : p.piece.mesh.vertices) {
      const Vec3 q = T * v.cast<double>();
      if (q.z() <= top) foot.extend(q);
    }
  }
  return Eigen::Translation3d(-foot.center().x(), -foot.center().y(), -box.min().z()) * T;
}

void add_colored(const PlantScan& scan, MeshPiece piece, std::vector<ClassifiedPiece>* pieces) {
  const auto fruit = triangles_of_color(piece, *scan.fruit_color);
  for (const int value : {0, 1}) {
    ClassifiedPiece part;
    part.piece = selected(piece, fruit, value);
    part.kind = value == 1 ? PartClass::fruit : PartClass::leaf;
    part.plant = true;
    if (!part.piece.mesh.triangles.empty()) pieces->push_back(std::move(part));
  }
}

/// One scan in its plant's frame.
Expected<std::vector<ClassifiedPiece>> read_scan(const PlantScan& scan, TextureStore& textures,
                                                 std::vector<std::string>* notices) {
  auto file = read_mesh_file(scan.mesh, {}, textures);
  if (!file) return tl::unexpected(file.error());
  notices->insert(notices->end(), file->notices.begin(), file->notices.end());
  const auto patterns = NamePatterns::compile(scan.patterns);
  if (!patterns) return tl::unexpected(patterns.error());
  std::vector<ClassifiedPiece> pieces;
  for (MeshPiece& piece : file->pieces) {
    const auto kind = patterns->class_of(piece.names);
    if (scan.fruit_color && !kind) {
      add_colored(scan, std::move(piece), &pieces);
      continue;
    }
    ClassifiedPiece part;
    part.kind = kind.value_or(PartClass::leaf);
    part.counted = patterns->counted(piece.names);
    part.plant = true;
    part.piece = std::move(piece);
    pieces.push_back(std::move(part));
  }
  const Eigen::Affine3d T = plant_frame(scan, pieces);
  if (!scan.fruit_mesh.empty()) {
    auto fruits = read_mesh_file(scan.fruit_mesh, {}, textures);
    if (!fruits) return tl::unexpected(fruits.error());
    notices->insert(notices->end(), fruits->notices.begin(), fruits->notices.end());
    for (MeshPiece& piece : fruits->pieces) {
      ClassifiedPiece part;
      part.kind = PartClass::fruit;
      part.counted = patterns->counted(piece.names);
      part.plant = true;
      part.piece = std::move(piece);
      pieces.push_back(std::move(part));
    }
  }
  for (ClassifiedPiece& p : pieces) p.piece = placed(p.piece, T);
  return pieces;
}

/// Sums the colours a fruit's surface shows.
struct MeanColor {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;

  [[nodiscard]] Rgb mean() const {
    const Vec3 m = sum / std::max(count, 1.0);
    return {static_cast<std::uint8_t>(m.x()), static_cast<std::uint8_t>(m.y()),
            static_cast<std::uint8_t>(m.z())};
  }
};

/// Fruits of a scan count when their mean colour does.
void count_by_color(const ScanRowsOptions& options, Scene* scene) {
  std::vector<MeanColor> colors(scene->fruits.size());
  for (const ScenePart& part : scene->parts) {
    if (part.fruit < 0) continue;
    MeshPiece piece;
    piece.texture = part.texture;
    piece.uv = part.uv;
    piece.vertex_colors = part.vertex_colors;
    piece.color = part.color;
    MeanColor& mean = colors[static_cast<std::size_t>(part.fruit)];
    for (std::uint32_t i = 0; i < part.mesh.vertices.size(); ++i) {
      const Rgb c = color_at(piece, i);
      mean.sum += Vec3(c.r, c.g, c.b);
      mean.count += 1.0;
    }
  }
  for (FruitTruth& fruit : scene->fruits) {
    // Plants are numbered in the order of the placements that show something.
    const auto& placement = options.plants[static_cast<std::size_t>(fruit.plant)];
    const auto& range = options.scans[static_cast<std::size_t>(placement.scan)].counted_color;
    if (!range) continue;
    fruit.counted = range->holds(colors[static_cast<std::size_t>(fruit.id)].mean());
    fruit.ripeness = fruit.counted ? Ripeness::ripe : Ripeness::green;
  }
}

ClassifiedPiece floor_around(const std::vector<ScanPlacement>& plants) {
  Box box;
  for (const ScanPlacement& p : plants) box.extend(p.position);
  ClassifiedPiece floor;
  const Vec3 size = box.sizes() + Vec3(2.0 * kMargin, 2.0 * kMargin, 0.0);
  MeshPiece& piece = floor.piece;
  piece.mesh = box_mesh({size.x(), size.y(), 0.05});
  piece.color = {124, 112, 100};
  piece.names.model = "floor";
  piece = placed(piece,
                 Eigen::Affine3d(Eigen::Translation3d(box.center().x(), box.center().y(), -0.025)));
  return floor;
}

}  // namespace

bool ColorRange::holds(Rgb color) const {
  const double high = std::max({color.r, color.g, color.b});
  const double low = std::min({color.r, color.g, color.b});
  if (high < 255.0 * min_value || high <= low || high - low < min_saturation * high) return false;
  double hue = 0.0;
  if (color.r == high) {
    hue = (color.g - color.b) / (high - low);
  } else if (color.g == high) {
    hue = 2.0 + (color.b - color.r) / (high - low);
  } else {
    hue = 4.0 + (color.r - color.g) / (high - low);
  }
  hue *= 60.0;
  while (hue < hue_low_deg) hue += 360.0;
  while (hue - 360.0 >= hue_low_deg) hue -= 360.0;
  return hue <= hue_high_deg;
}

Expected<ImportedScene> place_scans(const ScanRowsOptions& options,
                                    const ImportProgressCallback& progress) {
  TextureStore textures;
  std::vector<std::string> notices;
  std::vector<std::vector<ClassifiedPiece>> scans;
  for (const PlantScan& scan : options.scans) {
    auto read = read_scan(scan, textures, &notices);
    if (!read) return fail_in("scan '" + scan.name + "'", read.error());
    scans.push_back(std::move(*read));
  }
  std::vector<ClassifiedPiece> all;
  ImportProgress at{0, options.plants.size(), 0};
  for (const ScanPlacement& plant : options.plants) {
    const Pose T_world_plant =
        Eigen::Translation3d(plant.position) * Eigen::AngleAxisd(plant.yaw_rad, Vec3::UnitZ());
    for (const ClassifiedPiece& p : scans[static_cast<std::size_t>(plant.scan)]) {
      ClassifiedPiece copy = p;
      copy.piece = placed(p.piece, Eigen::Affine3d(T_world_plant));
      copy.piece.names.model = options.scans[static_cast<std::size_t>(plant.scan)].name + "_" +
                               std::to_string(at.done + 1);
      at.triangles += copy.piece.mesh.triangles.size();
      all.push_back(std::move(copy));
    }
    ++at.done;
    if (progress) progress(at);
  }
  if (options.floor && !options.plants.empty()) all.push_back(floor_around(options.plants));
  ImportedScene result = assemble_scene(options.name, std::move(all), options.fruits);
  count_by_color(options, &result.scene);
  result.notices.insert(result.notices.begin(), notices.begin(), notices.end());
  if (result.scene.fruits.empty()) {
    result.notices.push_back("no fruit: no surface of fruit size has the given colour or name");
  }
  return result;
}

}  // namespace canopeer
