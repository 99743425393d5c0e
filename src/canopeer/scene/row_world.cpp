#include "canopeer/scene/row_world.h"

#include <algorithm>
#include <utility>

#include "canopeer/scene/distractors.h"
#include "canopeer/scene/flat_faces.h"
#include "canopeer/scene/plant.h"

namespace canopeer {
namespace {

constexpr Rgb kFloorColor{124, 112, 100};
constexpr Rgb kWallColor{236, 242, 234};
constexpr Rgb kSlabColor{226, 226, 222};
constexpr int kAttempts = 24;  // to grow a plant clear of its neighbours' fruits
constexpr double kFruitClearance =
    0.008;  // half a leaf facet: between vertices a surface may bulge

/// A plant at its place: what is needed to see whether it touches another one.
struct PlacedPlant {
  Plant plant;
  Pose T_world_plant = Pose::Identity();
  Box bounds;
};

PlacedPlant place(Plant plant, const PlantPlacement& placement) {
  PlacedPlant placed;
  placed.T_world_plant = Eigen::Translation3d(placement.position) *
                         Eigen::AngleAxisd(placement.yaw_rad, Vec3::UnitZ());
  placed.plant = std::move(plant);
  Box box;
  for (const ScenePart& part : placed.plant.parts) box.extend(part.mesh.bounds());
  placed.bounds = transformed(box, placed.T_world_plant);
  return placed;
}

/// Does any surface of `other` come to a fruit of `owner`?
bool fruit_touched(const PlacedPlant& owner, const PlacedPlant& other) {
  if (!owner.bounds.intersects(other.bounds)) return false;
  const Pose T_owner_other = owner.T_world_plant.inverse(Eigen::Isometry) * other.T_world_plant;
  for (const ScenePart& part : other.plant.parts) {
    for (const auto& v : part.mesh.vertices) {
      const Vec3 p = T_owner_other * v.cast<double>();
      for (const HangingFruit& fruit : owner.plant.hanging) {
        if (touches_fruit(fruit, p, kFruitClearance)) return true;
      }
    }
  }
  return false;
}

bool clear_of(const PlacedPlant& plant, const std::vector<PlacedPlant>& others) {
  return std::none_of(others.begin(), others.end(), [&](const PlacedPlant& other) {
    return fruit_touched(plant, other) || fruit_touched(other, plant);
  });
}

/// Grows the plants one after the other, each again until it leaves the others' fruits alone.
std::vector<PlacedPlant> grow_rows(const WorldOptions& options, std::uint64_t seed) {
  std::vector<PlacedPlant> plants;
  for (std::size_t i = 0; i < options.plants.size(); ++i) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      Rng rng(seed, "plant", i * kAttempts + static_cast<std::uint64_t>(attempt));
      PlacedPlant grown =
          place(grow_plant(plant_kind(options.plants[i].kind), rng), options.plants[i]);
      if (attempt + 1 == kAttempts || clear_of(grown, plants)) {
        plants.push_back(std::move(grown));
        break;
      }
    }
  }
  return plants;
}

void add_distractors(const WorldOptions& options, std::uint64_t seed,
                     std::vector<PlacedPlant>* plants) {
  if (plants->empty()) return;
  for (int i = 0; i < options.distractors; ++i) {
    Rng rng(seed, "distractor", static_cast<std::uint64_t>(i));
    PlacedPlant& host = (*plants)[rng.index(plants->size())];
    for (ScenePart& part : make_distractor(host.plant, i, rng)) {
      host.plant.parts.push_back(std::move(part));
    }
  }
}

void add_plant(const PlacedPlant& placed, int index, Scene* scene) {
  const int first_fruit = static_cast<int>(scene->fruits.size());
  for (const ScenePart& local : placed.plant.parts) {
    ScenePart part = local;
    part.mesh = {};
    part.mesh.append(local.mesh, placed.T_world_plant);
    part.plant = index;
    if (part.fruit >= 0) part.fruit += first_fruit;
    scene->parts.push_back(std::move(part));
  }
  for (FruitTruth fruit : placed.plant.fruits) {
    fruit.id += first_fruit;
    fruit.plant = index;
    fruit.centre = placed.T_world_plant * fruit.centre;
    scene->fruits.push_back(fruit);
  }
}

void add_box(const Vec3& low, const Vec3& high, Rgb color, Scene* scene) {
  ScenePart part;
  part.mesh = with_flat_faces(make_box(Box(low, high)));
  part.color = color;
  scene->parts.push_back(std::move(part));
}

void add_room(const WorldOptions& o, Scene* scene) {
  constexpr double kThickness = 0.05;
  const double x = o.wall_x_m;
  const double y = o.half_length_m;
  if (o.floor) add_box({-x, -y, -kThickness}, {x, y, 0.0}, kFloorColor, scene);
  if (o.walls) {
    add_box({-x - kThickness, -y, 0.0}, {-x, y, o.wall_height_m}, kWallColor, scene);
    add_box({x, -y, 0.0}, {x + kThickness, y, o.wall_height_m}, kWallColor, scene);
  }
  for (const PlantPlacement& p : o.plants) {
    // What stands above the floor stands on a slab.
    const Vec3 half(0.1, 0.1, 0.0);
    if (o.floor && p.position.z() > 1e-6) {
      add_box(Vec3(p.position.x(), p.position.y(), 0.0) - half, p.position + half, kSlabColor,
              scene);
    }
  }
}

}  // namespace

WorldOptions scenario_1_world() {
  WorldOptions options;
  options.name = "scenario_1";
  constexpr int kLeft[] = {4, 9, 8, 7, 5, 6};   // x = −0.75
  constexpr int kRight[] = {5, 1, 7, 6, 2, 3};  // x = +0.75
  for (int i = 0; i < 6; ++i) {
    const double z = kLeft[i] == 6 ? 0.05 : 0.0;
    options.plants.push_back({kLeft[i], Vec3(-0.75, -1.25 + 0.5 * i, z), 0.0});
  }
  for (int i = 0; i < 6; ++i) {
    options.plants.push_back({kRight[i], Vec3(0.75, -1.25 + 0.5 * i, 0.0), 0.0});
  }
  return options;
}

Scene make_world(const WorldOptions& options, std::uint64_t seed) {
  Scene scene;
  scene.name = options.name;
  scene.seed = seed;
  std::vector<PlacedPlant> plants = grow_rows(options, seed);
  add_distractors(options, seed, &plants);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    add_plant(plants[i], static_cast<int>(i), &scene);
  }
  add_room(options, &scene);
  if (options.pipes) {
    Rng rng(seed, "pipe");
    for (const double x : {-1.1, 1.1}) {
      scene.parts.push_back(make_pipe(x, options.half_length_m, rng));
    }
  }
  return scene;
}

}  // namespace canopeer
