#include "false_spots.h"

#include "canopeer/base/rng.h"
#include "canopeer/fruit/surface/voxel_key.h"

namespace canopeer {
namespace {

constexpr int kSpots = 160;
constexpr double kCell_m = 0.1;
constexpr double kFruitReach_m = 0.06;

/// A random point of a random part.
Vec3 point_on(const std::vector<const ScenePart*>& parts, Rng& rng) {
  const ScenePart& part = *parts[rng.index(parts.size())];
  const auto& t = part.mesh.triangles[rng.index(part.mesh.triangles.size())];
  return part.mesh.vertices[t[0]].cast<double>();
}

}  // namespace

FalseSpots::FalseSpots(const Scene& scene, std::uint64_t seed) : seed_(seed) {
  std::vector<const ScenePart*> leaves;
  std::vector<const ScenePart*> others;
  for (const ScenePart& part : scene.parts) {
    if (part.fruit >= 0 || part.mesh.triangles.empty() || part.static_structure()) continue;
    (part.kind == PartClass::leaf ? leaves : others).push_back(&part);
  }
  Rng rng(seed, "false spots");
  for (int i = 0; i < kSpots; ++i) {
    // Half of them on leaves, half on what else is no fruit.
    const auto& parts = (i % 2 == 0 && !others.empty()) || leaves.empty() ? others : leaves;
    if (parts.empty()) break;
    const Vec3 centre = point_on(parts, rng);
    add({centre, rng.uniform(0.015, 0.05), rng.uniform(0.4, 1.0), true});
  }
  for (const FruitTruth& fruit : scene.fruits) {
    add({fruit.centre, kFruitReach_m, rng.uniform(0.0, 0.5), false});
  }
}

void FalseSpots::add(const Spot& spot) {
  const int number = static_cast<int>(spots_.size());
  spots_.push_back(spot);
  const Vec3 reach = Vec3::Constant(spot.radius_m);
  const VoxelIndex low = voxel_at(Vec3(spot.centre - reach), kCell_m);
  const VoxelIndex high = voxel_at(Vec3(spot.centre + reach), kCell_m);
  for (int x = low.x(); x <= high.x(); ++x) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int z = low.z(); z <= high.z(); ++z) near_[voxel_key({x, y, z})].push_back(number);
    }
  }
}

void FalseSpots::apply(const RgbdFrame& truth, std::uint64_t frame_number, Mask& fruit) const {
  std::vector<char> wrong;
  for (std::size_t i = 0; i < spots_.size(); ++i) {
    Rng rng(seed_ ^ frame_number << 20U, "wrong spot", i);
    wrong.push_back(rng.chance(spots_[i].wrong) ? 1 : 0);
  }
  Rng pixels(seed_ ^ frame_number << 20U, "wrong pixels");
  for (int v = 0; v < truth.depth.height(); ++v) {
    for (int u = 0; u < truth.depth.width(); ++u) {
      const double z = truth.depth.at(u, v);
      if (!(z > 0.0) || z > 2.0) continue;
      const Vec3 p = truth.T_world_camera * Vec3(z * truth.intrinsics.ray(u, v));
      const auto here = near_.find(voxel_key(voxel_at(p, kCell_m)));
      if (here == near_.end()) continue;
      const bool is_fruit = truth.labels.at(u, v) != PixelLabel::background;
      for (const int i : here->second) {
        const Spot& spot = spots_[static_cast<std::size_t>(i)];
        if (wrong[static_cast<std::size_t>(i)] == 0 || spot.says_fruit == is_fruit) continue;
        if ((p - spot.centre).squaredNorm() > spot.radius_m * spot.radius_m) continue;
        if (pixels.chance(0.05)) continue;
        const auto ripe = static_cast<std::uint8_t>(PixelLabel::ripe_fruit);
        fruit.at(u, v) = spot.says_fruit ? ripe : std::uint8_t{0};
      }
    }
  }
}

}  // namespace canopeer
