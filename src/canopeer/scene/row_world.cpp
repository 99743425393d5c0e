#include "canopeer/scene/row_world.h"

#include <algorithm>
#include <map>
#include <utility>

#include "canopeer/scene/flat_faces.h"
#include "canopeer/scene/plants/tube.h"
#include "canopeer/scene/rows/distractors.h"
#include "canopeer/scene/rows/plant_rows.h"

namespace canopeer {
namespace {

constexpr Rgb kFloorColor{124, 112, 100};
constexpr Rgb kWallColor{236, 242, 234};
constexpr Rgb kSlabColor{226, 226, 222};
constexpr Rgb kGutterColor{205, 210, 212};
constexpr Rgb kBoardColor{176, 150, 116};
constexpr Rgb kStringColor{238, 236, 226};

void add_distractors(const WorldOptions& options, std::uint64_t seed,
                     std::vector<PlacedPlant>* plants) {
  if (plants->empty() || options.copies > 0) return;
  for (int i = 0; i < options.distractors; ++i) {
    Rng rng(seed, "distractor", static_cast<std::uint64_t>(i));
    PlacedPlant& host = (*plants)[rng.index(plants->size())];
    for (ScenePart& part : make_distractor(*host.plant, i, rng)) {
      host.plant->parts.push_back(std::move(part));
    }
  }
}

void add_fruits(const PlacedPlant& placed, int index, Scene* scene) {
  const int first_fruit = static_cast<int>(scene->fruits.size());
  for (FruitTruth fruit : placed.plant->fruits) {
    fruit.id += first_fruit;
    fruit.plant = index;
    fruit.centre = placed.T_world_plant * fruit.centre;
    scene->fruits.push_back(fruit);
  }
}

void add_plant(const PlacedPlant& placed, int index, Scene* scene) {
  const int first_fruit = static_cast<int>(scene->fruits.size());
  for (const ScenePart& local : placed.plant->parts) {
    ScenePart part = local;
    part.mesh = {};
    part.mesh.append(local.mesh, placed.T_world_plant);
    part.plant = index;
    if (part.fruit >= 0) part.fruit += first_fruit;
    scene->parts.push_back(std::move(part));
  }
}

void add_copy(const PlacedPlant& placed, int index, Rng& rng, Scene* scene) {
  SceneInstance instance;
  instance.model = static_cast<std::size_t>(placed.model);
  instance.T_world_model = placed.T_world_plant;
  instance.plant = index;
  instance.first_fruit = static_cast<int>(scene->fruits.size());
  instance.brightness = static_cast<float>(rng.uniform(0.92, 1.06));
  if (scene->models.size() <= instance.model) scene->models.resize(instance.model + 1);
  std::vector<ScenePart>& parts = scene->models[instance.model].parts;
  if (parts.empty()) parts = placed.plant->parts;
  scene->instances.push_back(instance);
}

void add_plants(const std::vector<PlacedPlant>& plants, std::uint64_t seed, Scene* scene) {
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const int index = static_cast<int>(i);
    if (plants[i].model < 0) {
      add_plant(plants[i], index, scene);
    } else {
      Rng rng(seed, "copy brightness", i);
      add_copy(plants[i], index, rng, scene);
    }
    add_fruits(plants[i], index, scene);
  }
}

/// A string from half way up each shoot to the wire over it.
void add_strings(const PlacedPlant& placed, int index, Scene* scene) {
  constexpr double kRadius = 0.0012;
  for (const Shoot& shoot : placed.plant->shoots) {
    const Vec3 low = shoot.at(0.5 * shoot.length_m).position;
    const Vec3 tip = shoot.at(shoot.length_m).position;
    if (tip.z() >= placed.string_m) continue;
    ScenePart part;
    part.mesh.append(make_tube({{low + Vec3(0.008, 0.0, 0.0), kRadius},
                                {tip + Vec3(0.006, 0.0, 0.0), kRadius},
                                {Vec3(tip.x(), tip.y(), placed.string_m), kRadius}},
                               5),
                     placed.T_world_plant);
    part.kind = PartClass::support;
    part.plant = index;
    part.color = kStringColor;
    scene->parts.push_back(std::move(part));
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
  if (o.floor) add_box({-x, o.low_y_m, -kThickness}, {x, o.high_y_m, 0.0}, kFloorColor, scene);
  if (o.walls) {
    add_box({-x - kThickness, o.low_y_m, 0.0}, {-x, o.high_y_m, o.wall_height_m}, kWallColor,
            scene);
    add_box({x, o.low_y_m, 0.0}, {x + kThickness, o.high_y_m, o.wall_height_m}, kWallColor, scene);
  }
  for (const Box& board : o.boards) add_box(board.min(), board.max(), kBoardColor, scene);
}

/// Height of the surface a plant stands over, boards included.
double ground_under(const WorldOptions& o, const Vec3& position) {
  double ground = 0.0;
  for (const Box& board : o.boards) {
    const Vec3 on_top(position.x(), position.y(), board.max().z());
    if (board.contains(on_top) && on_top.z() <= position.z() + 1e-6) {
      ground = std::max(ground, on_top.z());
    }
  }
  return ground;
}

/// What stands above its ground stands on a slab.
void add_slabs(const WorldOptions& o, Scene* scene) {
  const Vec3 half(0.1, 0.1, 0.0);
  for (const PlantPlacement& p : o.plants) {
    const double ground = ground_under(o, p.position);
    if (p.position.z() <= ground + 1e-6) continue;
    add_box(Vec3(p.position.x(), p.position.y(), ground) - half, p.position + half, kSlabColor,
            scene);
  }
}

/// A gutter under every row that stands above the floor: plants of one x and z.
void add_gutters(const WorldOptions& o, Scene* scene) {
  constexpr double kHalfWidth = 0.11;
  constexpr double kHeight = 0.07;
  constexpr double kBeyond = 0.3;
  std::map<std::pair<double, double>, std::pair<double, double>> rows;
  for (const PlantPlacement& p : o.plants) {
    if (p.position.z() < kHeight) continue;
    auto [row, is_new] =
        rows.try_emplace({p.position.x(), p.position.z()}, p.position.y(), p.position.y());
    row->second.first = std::min(row->second.first, p.position.y());
    row->second.second = std::max(row->second.second, p.position.y());
  }
  for (const auto& [place, ends] : rows) {
    const auto [x, z] = place;
    add_box({x - kHalfWidth, ends.first - kBeyond, z - kHeight},
            {x + kHalfWidth, ends.second + kBeyond, z}, kGutterColor, scene);
  }
}

}  // namespace

Scene make_world(const WorldOptions& options, std::uint64_t seed) {
  Scene scene;
  scene.name = options.name;
  scene.seed = seed;
  std::vector<PlacedPlant> plants = grow_rows(options, seed);
  add_distractors(options, seed, &plants);
  add_plants(plants, seed, &scene);
  for (std::size_t i = 0; options.strings && i < plants.size(); ++i) {
    add_strings(plants[i], static_cast<int>(i), &scene);
  }
  scene.ground_m2 = options.ground_per_plant_m2 * static_cast<double>(plants.size());
  add_room(options, &scene);
  if (options.gutters) {
    add_gutters(options, &scene);
  } else if (options.floor) {
    add_slabs(options, &scene);
  }
  if (options.pipes) {
    Rng rng(seed, "pipe");
    for (const double x : options.pipe_x_m) {
      scene.parts.push_back(make_pipe(x, options.low_y_m, options.high_y_m, rng));
    }
  }
  return scene;
}

}  // namespace canopeer
