#include "canopeer/scene/rows/distractors.h"

#include <algorithm>
#include <cmath>

#include "canopeer/geometry/angles.h"
#include "canopeer/scene/flat_faces.h"
#include "canopeer/scene/plants/leaf.h"
#include "canopeer/scene/plants/plant_colors.h"

namespace canopeer {
namespace {

constexpr Rgb kClipRed{190, 34, 38};
constexpr Rgb kDryLeaf{122, 70, 38};
constexpr Rgb kLabelPink{222, 118, 140};
constexpr Rgb kTerracotta{168, 92, 64};

ScenePart make_distractor(TriangleMesh mesh, Rgb color) {
  ScenePart part;
  part.mesh = std::move(mesh);
  part.kind = PartClass::distractor;
  part.plant = 0;
  part.color = color;
  return part;
}

bool clear_of_fruits(const Plant& plant, const TriangleMesh& mesh) {
  return std::none_of(plant.hanging.begin(), plant.hanging.end(), [&](const HangingFruit& fruit) {
    return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Eigen::Vector3f& v) {
      return touches_fruit(fruit, v.cast<double>(), 0.01);
    });
  });
}

/// A tie around the stem, a little wider than it, with a knob.
TriangleMesh make_clip(const Shoot& shoot, double s, Rng& rng) {
  const double radius = shoot.at(s).radius_m + 0.003;
  TriangleMesh mesh =
      make_tube({{shoot.at(s).position, radius}, {shoot.at(s + 0.018).position, radius}}, 10);
  const double azimuth = rng.uniform(0.0, 2.0 * kPi);
  const Vec3 knob = shoot.at(s + 0.009).position +
                    (radius + 0.003) * Vec3(std::cos(azimuth), std::sin(azimuth), 0.0);
  mesh.append(with_flat_faces(make_box(Box(Vec3::Constant(-0.005), Vec3::Constant(0.005)))),
              Pose(Eigen::Translation3d(knob)));
  return mesh;
}

TriangleMesh make_dry_leaf(const Shoot& shoot, double s, Rng& rng) {
  LeafForm leaf;
  leaf.length_m = rng.uniform(0.06, 0.10);
  leaf.width_m = 0.45 * leaf.length_m;
  leaf.petiole_m = 0.03;
  leaf.petiole_pitch_rad = -0.6;
  leaf.blade_pitch_rad = -1.25;
  leaf.bend_rad = 1.6;
  leaf.fold_rad = 0.8;
  leaf.twist_rad = 1.0;
  leaf.azimuth_rad = rng.uniform(0.0, 2.0 * kPi);
  const Vec3 node = shoot.at(s).position;
  TriangleMesh mesh = make_blade(leaf, petiole_end(leaf, node));
  mesh.append(make_petiole(leaf, node));
  return mesh;
}

TriangleMesh make_label(const Shoot& shoot, double s, Rng& rng) {
  TriangleMesh mesh = make_box(Box(Vec3(0.008, -0.0005, -0.03), Vec3(0.035, 0.0005, 0.03)));
  const double tilt = rng.uniform(-0.3, 0.3);
  const double azimuth = rng.uniform(0.0, 2.0 * kPi);
  const Pose T = Eigen::Translation3d(shoot.at(s).position) *
                 Eigen::AngleAxisd(azimuth, Vec3::UnitZ()) * Eigen::AngleAxisd(tilt, Vec3::UnitX());
  TriangleMesh placed;
  placed.append(mesh, T);
  return with_flat_faces(placed);
}

ScenePart make_one(const Plant& plant, int turn, Rng& rng) {
  const Shoot& shoot = plant.shoots[rng.index(plant.shoots.size())];
  switch (turn % 3) {
    case 0: {
      const Rgb color = vary_color(kClipRed, 0.06, 0.05, rng);
      return make_distractor(make_clip(shoot, shoot.length_m * rng.uniform(0.2, 0.75), rng), color);
    }
    case 1: {
      const Rgb color = vary_color(kDryLeaf, 0.12, 0.06, rng);
      return make_distractor(make_dry_leaf(shoot, shoot.length_m * rng.uniform(0.12, 0.35), rng),
                             color);
    }
    default: {
      const Rgb color = vary_color(kLabelPink, 0.05, 0.03, rng);
      return make_distractor(make_label(shoot, shoot.length_m * rng.uniform(0.1, 0.4), rng), color);
    }
  }
}

}  // namespace

std::vector<ScenePart> make_distractor(const Plant& plant, int turn, Rng& rng) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    ScenePart part = make_one(plant, turn, rng);
    if (part.mesh.bounds().min().z() > 0.0 && clear_of_fruits(plant, part.mesh)) {
      return {std::move(part)};
    }
  }
  return {};
}

ScenePart make_pipe(double x_m, double low_y_m, double high_y_m, Rng& rng) {
  constexpr double kRadius = 0.025;
  std::vector<AxisPoint> axis;
  for (int i = 0; i <= 16; ++i) {
    const double y = low_y_m + (high_y_m - low_y_m) * i / 16.0;
    axis.push_back({Vec3(x_m, y, kRadius + 0.02), kRadius});
  }
  ScenePart part = make_distractor(make_tube(axis, 12), vary_color(kTerracotta, 0.04, 0.02, rng));
  part.plant = -1;
  return part;
}

}  // namespace canopeer
