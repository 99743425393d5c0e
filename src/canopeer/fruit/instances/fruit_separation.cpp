#include "canopeer/fruit/instances/fruit_separation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "canopeer/fruit/confidence/plausibility.h"
#include "canopeer/fruit/instances/vote_peaks.h"

namespace canopeer {
namespace {

constexpr int kRounds = 3;
constexpr double kGate_m = 0.010;      // a fruit's own points are this near to its ellipsoid
constexpr double kMinNormalCos = 0.3;  // and face about the same way
constexpr std::size_t kFitPoints = 96;

/// Shape of the chosen points; many points are thinned evenly, which changes little and saves time.
ShapeEstimate shape_of(std::span<const SurfacePoint> surface, const std::vector<int>& points,
                       const ShapePrior& prior, const std::optional<ShapeEstimate>& from = {}) {
  const std::size_t stride = (points.size() + kFitPoints - 1) / kFitPoints;
  std::vector<SurfacePoint> chosen;
  for (std::size_t i = 0; i < points.size(); i += stride) chosen.push_back(surface[points[i]]);
  return estimate_shape(chosen, prior, from);
}

constexpr double kReach_m = 0.09;  // of a fruit's own points from its centre

/// How far a point is from being a fruit's own; none: it is not.
std::optional<double> misfit(const ShapeEstimate& shape, const SurfacePoint& s) {
  if ((s.point - shape.centre).squaredNorm() > kReach_m * kReach_m) return std::nullopt;
  const double distance = std::abs(shape.radial_distance(s.point));
  if (distance > kGate_m || shape.normal_at(s.point).dot(s.normal) < kMinNormalCos) {
    return std::nullopt;
  }
  return distance;
}

/// Each point goes to the fruit it fits best, or to none. Points come in the order of the blocks
/// they lie in, so most fruits are too far away for a whole stretch of them.
void assign_points(std::span<const SurfacePoint> surface, std::vector<SeparatedFruit>& fruits) {
  constexpr std::size_t kStretch = 32;
  for (SeparatedFruit& fruit : fruits) fruit.points.clear();
  std::vector<SeparatedFruit*> near;
  for (std::size_t from = 0; from < surface.size(); from += kStretch) {
    const std::size_t to = std::min(surface.size(), from + kStretch);
    Box bounds;
    for (std::size_t i = from; i < to; ++i) bounds.extend(surface[i].point);
    near.clear();
    for (SeparatedFruit& fruit : fruits) {
      if (bounds.squaredExteriorDistance(fruit.shape.centre) <= kReach_m * kReach_m) {
        near.push_back(&fruit);
      }
    }
    for (std::size_t i = from; i < to; ++i) {
      SeparatedFruit* best = nullptr;
      double least = kGate_m + 1.0;
      for (SeparatedFruit* fruit : near) {
        const std::optional<double> distance = misfit(fruit->shape, surface[i]);
        if (distance && *distance < least) {
          least = *distance;
          best = fruit;
        }
      }
      if (best != nullptr) best->points.push_back(static_cast<int>(i));
    }
  }
}

void refit(std::span<const SurfacePoint> surface, const FruitMapOptions& options,
           std::vector<SeparatedFruit>& fruits) {
  std::erase_if(fruits, [&](const SeparatedFruit& fruit) {
    return static_cast<int>(fruit.points.size()) < options.min_cluster_points;
  });
  for (SeparatedFruit& fruit : fruits) {
    fruit.shape = shape_of(surface, fruit.points, options.prior, fruit.shape);
  }
}

/// The two as one fruit, when one ellipsoid explains both.
std::optional<SeparatedFruit> as_one(std::span<const SurfacePoint> surface, const SeparatedFruit& a,
                                     const SeparatedFruit& b, const FruitMapOptions& options) {
  SeparatedFruit one;
  std::merge(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
             std::back_inserter(one.points));
  one.shape = shape_of(surface, one.points, options.prior);
  const double rms = std::max({a.shape.rms_m, b.shape.rms_m, options.prior.surface_sd_m});
  const ShapePrior& prior = options.prior;
  const bool ordinary =
      one.shape.radius_m < prior.radius_m + 2.5 * prior.radius_sd_m &&
      one.shape.half_length_m < prior.half_length_m + 2.5 * prior.half_length_sd_m;
  if (one.shape.rms_m > 1.3 * rms || !ordinary) return std::nullopt;
  return one;
}

/// Two centres nearer than a fruit's size are one fruit seen in pieces, or one is spurious.
void merge_coinciding(std::span<const SurfacePoint> surface, const FruitMapOptions& options,
                      std::vector<SeparatedFruit>& fruits) {
  constexpr double kMaybeOne = 1.4;  // × min_centre_distance_m
  for (std::size_t i = 0; i < fruits.size(); ++i) {
    for (std::size_t j = i + 1; j < fruits.size();) {
      const double distance = (fruits[i].shape.centre - fruits[j].shape.centre).norm();
      if (distance > kMaybeOne * options.min_centre_distance_m) {
        ++j;
      } else if (auto one = as_one(surface, fruits[i], fruits[j], options)) {
        fruits[i] = std::move(*one);
        fruits.erase(fruits.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      } else if (distance < options.min_centre_distance_m) {
        if (fruits[j].points.size() > fruits[i].points.size()) std::swap(fruits[i], fruits[j]);
        fruits.erase(fruits.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      } else {
        ++j;
      }
    }
  }
}

}  // namespace

std::vector<SeparatedFruit> separate_fruits(std::span<const SurfacePoint> surface,
                                            const FruitMapOptions& options) {
  std::vector<SeparatedFruit> fruits;
  for (const Vec3& peak :
       vote_peaks(surface, options.prior, options.min_centre_distance_m, options.min_points / 3)) {
    SeparatedFruit& fruit = fruits.emplace_back();
    fruit.shape.centre = peak;
    fruit.shape.radius_m = options.prior.radius_m;
    fruit.shape.half_length_m = options.prior.half_length_m;
  }
  for (int round = 0; round < kRounds; ++round) {
    assign_points(surface, fruits);
    refit(surface, options, fruits);
    merge_coinciding(surface, options, fruits);
  }
  std::erase_if(fruits, [&](const SeparatedFruit& fruit) {
    return !is_fruit(surface, fruit.points, fruit.shape, options);
  });
  return fruits;
}

}  // namespace canopeer
