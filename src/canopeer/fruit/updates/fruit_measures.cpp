#include <algorithm>
#include <cmath>
#include <optional>

#include "canopeer/fruit/instances/fruit_separation.h"
#include "canopeer/fruit/missing_surface.h"
#include "canopeer/fruit/surface/voxel_key.h"
#include "canopeer/fruit/updates/fruit_map_state.h"

namespace canopeer {

/// The patch's fruits with what can be said before their shapes are fitted.
void FruitMap::State::solve(const Patch& patch, std::vector<KnownFruit>& found) const {
  for (const SeparatedFruit& separated : separate_fruits(patch.surface, options)) {
    KnownFruit& fruit = found.emplace_back();
    FruitEstimate& e = fruit.estimate;
    e.points = static_cast<int>(separated.points.size());
    Eigen::Array3d color = Eigen::Array3d::Zero();
    std::array<int, kPixelLabels> votes{};
    double fruit_share = 0.0;
    for (const int i : separated.points) {
      const SurfaceVertex& v = *patch.vertex[static_cast<std::size_t>(i)];
      fruit.cells.push_back(voxel_key(v.cell));
      fruit.blocks.push_back(patch.block[static_cast<std::size_t>(i)]);
      color += Eigen::Array3d(v.color.r, v.color.g, v.color.b);
      ++votes[static_cast<std::size_t>(v.kind)];
      fruit_share += static_cast<double>(v.fruit_share);
    }
    sort_unique(fruit.cells);
    sort_unique(fruit.blocks);
    color = color / e.points + 0.5;
    e.color = {static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
               static_cast<std::uint8_t>(color[2])};
    e.ripeness =
        static_cast<PixelLabel>(std::max_element(votes.begin() + 1, votes.end()) - votes.begin());
    e.centre = separated.shape.centre;
    fruit.seen.fruit_share = fruit_share / e.points;
    fruit.seen.normal_spread = normal_spread(patch.surface, separated.points);
    fruit.seen.foreign_share = foreign_share(separated.shape, fruit);
    fruit.surface.reserve(separated.points.size());
    for (const int i : separated.points) {
      fruit.surface.push_back(patch.surface[static_cast<std::size_t>(i)]);
    }
  }
}

/// Of the surface around the fruit that lies on its shape and faces the same way, how much pixels
/// took for something else: the rest of the leaf when the fruit is a red spot on one.
double FruitMap::State::foreign_share(const ShapeEstimate& shape, const KnownFruit& fruit) const {
  constexpr double kOnShape_m = 0.008;
  constexpr double kMinCos = 0.7;
  int foreign = 0;
  for (const int block : fruit.blocks) {
    for (const SurfaceVertex& v : surface.vertices(block)) {
      if (counts(v)) continue;
      const SurfacePoint& s = v.surface;
      const bool on_shape = std::abs(shape.radial_distance(s.point)) < kOnShape_m;
      foreign += on_shape && shape.normal_at(s.point).dot(s.normal) > kMinCos;
    }
  }
  return static_cast<double>(foreign) / (foreign + fruit.estimate.points);
}

/// Of a shape's surface the share that lies well in the open: cameras looked through there.
double FruitMap::State::free_share(const std::vector<SurfacePoint>& shape) const {
  constexpr double kInside_m = 0.004;
  const auto open = static_cast<float>(0.5 * options.tsdf.truncation_m);
  int free = 0;
  for (const SurfacePoint& s : shape) {
    const Vec3 inside = s.point - kInside_m * s.normal;
    const auto distance = surface.tsdf().distance_at(voxel_at(inside, options.tsdf.voxel_m));
    free += distance && *distance > open;
  }
  return static_cast<double>(free) / static_cast<double>(shape.size());
}

/// Fits the fruit's shape, unless it is the one it was before; from there on when it was there.
void FruitMap::State::measure(KnownFruit& fruit, const KnownFruit* before,
                              const std::vector<int>& changed, bool anew) {
  FruitEstimate& e = fruit.estimate;
  const bool unchanged =
      before != nullptr && before->cells == fruit.cells && !share_element(fruit.blocks, changed);
  if (unchanged) {
    fruit.fit = before->fit;
    e.seen_share = before->estimate.seen_share;
    fruit.seen.free_share = before->seen.free_share;
  } else {
    std::optional<Superellipsoid> from;
    if (before != nullptr && !anew) from = before->fit.body;
    fruit.fit = fit_superellipsoid(fruit.surface, from ? again_options : fit_options, from);
    ++fits;
    constexpr int kSamples = 128;
    const std::vector<SurfacePoint> samples = fruit.fit.body.surface_samples(kSamples);
    e.seen_share = missing_surface(samples, fruit.surface).seen_share();
    fruit.seen.free_share = free_share(samples);
  }
  fruit.surface = {};
  set_shape(fruit.fit, e);
  e.place = place_in_rows(options.rows, e.centre);
  if (before != nullptr) {
    e.views = before->estimate.views;
    e.first_seen_s = before->estimate.first_seen_s;
    e.last_seen_s = before->estimate.last_seen_s;
  }
}

}  // namespace canopeer
