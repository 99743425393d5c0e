#include "canopeer/scene/rows/plant_rows.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace canopeer {
namespace {

constexpr int kAttempts = 24;  // to grow a plant clear of its neighbours' fruits
constexpr double kFruitClearance =
    0.008;  // half a leaf facet: between vertices a surface may bulge

PlacedPlant place(std::shared_ptr<Plant> plant, const PlantPlacement& placement, double yaw) {
  PlacedPlant placed;
  placed.T_world_plant =
      Eigen::Translation3d(placement.position) * Eigen::AngleAxisd(yaw, Vec3::UnitZ());
  placed.plant = std::move(plant);
  Box box;
  for (const ScenePart& part : placed.plant->parts) box.extend(part.mesh.bounds());
  placed.bounds = transformed(box, placed.T_world_plant);
  return placed;
}

/// Does this mesh of another plant come to one of the owner's fruits?
bool touches_fruits(const PlacedPlant& owner, const Pose& T_owner_other, const TriangleMesh& mesh) {
  return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Eigen::Vector3f& v) {
    const Vec3 p = T_owner_other * v.cast<double>();
    return std::any_of(
        owner.plant->hanging.begin(), owner.plant->hanging.end(),
        [&](const HangingFruit& fruit) { return touches_fruit(fruit, p, kFruitClearance); });
  });
}

Pose T_owner_other(const PlacedPlant& owner, const PlacedPlant& other) {
  return owner.T_world_plant.inverse(Eigen::Isometry) * other.T_world_plant;
}

/// Does any surface of `other` come to a fruit of `owner`?
bool fruit_touched(const PlacedPlant& owner, const PlacedPlant& other) {
  if (!owner.bounds.intersects(other.bounds)) return false;
  const Pose T = T_owner_other(owner, other);
  return std::any_of(other.plant->parts.begin(), other.plant->parts.end(),
                     [&](const ScenePart& part) { return touches_fruits(owner, T, part.mesh); });
}

bool clear_of(const PlacedPlant& plant, const std::vector<PlacedPlant>& others) {
  return std::none_of(others.begin(), others.end(), [&](const PlacedPlant& other) {
    return fruit_touched(plant, other) || fruit_touched(other, plant);
  });
}

/// Leaves out the leaves of `other` that come to a fruit of `owner`.
void give_way(const PlacedPlant& owner, PlacedPlant* other) {
  if (!owner.bounds.intersects(other->bounds)) return;
  const Pose T = T_owner_other(owner, *other);
  std::vector<ScenePart>& parts = other->plant->parts;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    // A blade is followed by its petiole.
    if (parts[i].kind != PartClass::leaf) continue;
    if (!touches_fruits(owner, T, parts[i].mesh) && !touches_fruits(owner, T, parts[i + 1].mesh)) {
      continue;
    }
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i),
                parts.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    --i;
  }
}

PlacedPlant grow_once(const PlantPlacement& placement, std::uint64_t seed, std::uint64_t stream) {
  Rng rng(seed, "plant", stream);
  Rng figures(seed, "plant kind", stream);
  const PlantKind kind = draw_plant_kind(placement.preset, placement.kind, figures);
  PlacedPlant placed =
      place(std::make_shared<Plant>(grow_plant(kind, rng)), placement, placement.yaw_rad);
  placed.string_m = kind.string_m;
  return placed;
}

std::vector<PlacedPlant> grow_each(const WorldOptions& options, std::uint64_t seed) {
  std::vector<PlacedPlant> plants;
  for (std::size_t i = 0; i < options.plants.size(); ++i) {
    const bool dense = options.plants[i].preset == PlantPreset::dense;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      PlacedPlant grown =
          grow_once(options.plants[i], seed, i * kAttempts + static_cast<std::uint64_t>(attempt));
      for (PlacedPlant& other : plants) {
        if (dense) give_way(other, &grown);
      }
      const bool last = attempt + 1 == kAttempts;
      if (!last && !dense && !clear_of(grown, plants)) continue;
      for (PlacedPlant& other : plants) {
        if (dense) give_way(grown, &other);
      }
      if (!last && dense && !clear_of(grown, plants)) continue;
      plants.push_back(std::move(grown));
      break;
    }
  }
  return plants;
}

/// A handful of grown plants in many places, each turned its own way.
std::vector<PlacedPlant> grow_copies(const WorldOptions& options, std::uint64_t seed) {
  const std::size_t count =
      std::min(static_cast<std::size_t>(options.copies), options.plants.size());
  std::vector<PlacedPlant> grown;
  for (std::size_t i = 0; i < count; ++i) {
    PlantPlacement origin = options.plants[i];
    origin.position = Vec3::Zero();
    origin.yaw_rad = 0.0;
    grown.push_back(grow_once(origin, seed, i * kAttempts));
  }
  std::vector<PlacedPlant> plants;
  for (std::size_t i = 0; i < options.plants.size(); ++i) {
    Rng rng(seed, "copy", i);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::size_t model = rng.index(count);
      PlacedPlant copy =
          place(grown[model].plant, options.plants[i], rng.uniform(0.0, 2.0 * std::numbers::pi));
      copy.model = static_cast<int>(model);
      copy.string_m = grown[model].string_m;
      if (attempt + 1 < kAttempts && !clear_of(copy, plants)) continue;
      plants.push_back(std::move(copy));
      break;
    }
  }
  return plants;
}

}  // namespace

std::vector<PlacedPlant> grow_rows(const WorldOptions& options, std::uint64_t seed) {
  return options.copies > 0 ? grow_copies(options, seed) : grow_each(options, seed);
}

}  // namespace canopeer
