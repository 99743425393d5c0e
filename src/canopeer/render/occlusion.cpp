#include "canopeer/render/occlusion.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "canopeer/base/rng.h"
#include "canopeer/render/rays/ray_caster.h"

namespace canopeer {
namespace {

constexpr std::size_t kPoints = 240;  // a fruit; the error of a share is below 3 %

struct SurfacePoint {
  Eigen::Vector3f position;  // world
  Eigen::Vector3f normal;
};

/// Points at even steps of the running area, anywhere in their triangle.
std::vector<SurfacePoint> spread_points(const TriangleMesh& mesh, const Pose& T) {
  std::vector<SurfacePoint> points;
  const double step = mesh.area() / static_cast<double>(kPoints);
  Rng rng(static_cast<std::uint64_t>(mesh.triangles.size()), "surface points");
  double until = 0.5 * step;
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = T * mesh.vertices[t[0]].cast<double>();
    const Vec3 b = T * mesh.vertices[t[1]].cast<double>();
    const Vec3 c = T * mesh.vertices[t[2]].cast<double>();
    const Vec3 n = (b - a).cross(c - a);
    area += 0.5 * n.norm();
    for (; until < area && points.size() < kPoints; until += step) {
      double u = rng.uniform();
      double v = rng.uniform();
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      points.push_back(
          {(a + u * (b - a) + v * (c - a)).cast<float>(), n.normalized().cast<float>()});
    }
  }
  return points;
}

std::vector<SurfaceSoup> soups_of(const std::vector<SceneModel>& models) {
  std::vector<SurfaceSoup> soups;
  for (const SceneModel& model : models) soups.push_back(make_surface_soup(model.parts));
  return soups;
}

std::vector<RayCaster::Placement> placements_of(const std::vector<SceneInstance>& instances) {
  std::vector<RayCaster::Placement> placements;
  for (const SceneInstance& i : instances) placements.push_back({i.model, i.T_world_model});
  return placements;
}

}  // namespace

struct OcclusionProbe::Impl {
  explicit Impl(const Scene& scene)
      : world(make_surface_soup(scene.parts)),
        models(soups_of(scene.models)),
        caster(world, models, placements_of(scene.instances)),
        points(scene.fruits.size()) {
    scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
      if (part.fruit < 0) return;
      const int fruit = part.fruit + (copy == nullptr ? 0 : copy->first_fruit);
      points[static_cast<std::size_t>(fruit)] = spread_points(part.mesh, T);
    });
  }

  SurfaceSoup world;
  std::vector<SurfaceSoup> models;
  RayCaster caster;
  std::vector<std::vector<SurfacePoint>> points;  // per fruit
};

OcclusionProbe::OcclusionProbe(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
OcclusionProbe::~OcclusionProbe() = default;

std::size_t OcclusionProbe::point_count(int fruit) const {
  return impl_->points[static_cast<std::size_t>(fruit)].size();
}

FruitView OcclusionProbe::view(int fruit, const Vec3& eye_world) const {
  constexpr float kOffSurface = 5e-4F;
  const Eigen::Vector3f eye = eye_world.cast<float>();
  const auto& points = impl_->points[static_cast<std::size_t>(fruit)];
  std::array<RayCaster::Ray, RayCaster::kPacket> rays;
  std::array<bool, RayCaster::kPacket> blocked{};
  std::array<std::uint32_t, RayCaster::kPacket> index{};
  FruitView result;
  std::size_t facing = 0;
  std::size_t waiting = 0;
  const auto cast = [&] {
    // From the eye to just above the surface: whatever is beyond does not matter.
    impl_->caster.blocked_between(std::span(rays).first(waiting),
                                  std::span(blocked).first(waiting));
    for (std::size_t i = 0; i < waiting; ++i) {
      if (!blocked[i]) result.points.push_back(index[i]);
    }
    waiting = 0;
  };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f to_eye = eye - points[i].position;
    if (points[i].normal.dot(to_eye) <= 0.0F) continue;
    ++facing;
    const Eigen::Vector3f start = points[i].position + kOffSurface * points[i].normal;
    rays[waiting] = {start, eye - start};
    index[waiting++] = i;
    if (waiting == rays.size()) cast();
  }
  if (waiting > 0) cast();
  if (facing > 0) {
    result.facing_share = static_cast<double>(result.points.size()) / static_cast<double>(facing);
  }
  return result;
}

std::vector<Vec3> ring_positions(const Vec3& fruit, const RingOptions& o) {
  std::vector<Vec3> eyes;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < o.directions; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / o.directions;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 direction(r * std::cos(golden * i), r * std::sin(golden * i), z);
    for (const double distance : o.distances_m) {
      const Vec3 eye = fruit + distance * direction;
      if (std::abs(eye.x()) <= o.aisle_half_m && eye.z() >= o.low_m && eye.z() <= o.top_m) {
        eyes.push_back(eye);
      }
    }
  }
  return eyes;
}

namespace {

/// Level with the fruit and at most 30° to the side of straight in front.
std::vector<Vec3> frontal_positions(const Vec3& fruit) {
  std::vector<Vec3> eyes;
  const double towards_aisle = fruit.x() > 0.0 ? -1.0 : 1.0;
  for (const double distance : {0.55, 0.7}) {
    for (int k = -3; k <= 3; ++k) {
      const double angle = k * std::numbers::pi / 18.0;
      eyes.push_back(fruit + distance * Vec3(towards_aisle * std::cos(angle), std::sin(angle), 0));
    }
  }
  return eyes;
}

class Union {
 public:
  explicit Union(std::size_t points) : seen_(points, 0) {}
  void add(const FruitView& view) {
    for (const std::uint32_t i : view.points) seen_[i] = 1;
  }
  [[nodiscard]] double share() const {
    return static_cast<double>(std::count(seen_.begin(), seen_.end(), 1)) /
           static_cast<double>(std::max<std::size_t>(1, seen_.size()));
  }

 private:
  std::vector<char> seen_;
};

}  // namespace

FruitVisibility visibility(const OcclusionProbe& probe, const FruitTruth& fruit,
                           const std::vector<Vec3>& eyes) {
  FruitVisibility result;
  result.fruit = fruit.id;
  result.views = static_cast<int>(eyes.size());
  Union all(probe.point_count(fruit.id));
  std::vector<double> shares;
  int above = 0;
  for (const Vec3& eye : eyes) {
    const FruitView view = probe.view(fruit.id, eye);
    all.add(view);
    shares.push_back(view.facing_share);
    above += view.facing_share >= 0.3;
  }
  if (!shares.empty()) {
    std::sort(shares.begin(), shares.end());
    result.best = shares.back();
    result.median = shares[shares.size() / 2];
    result.share_above_30 = above / static_cast<double>(shares.size());
  }
  result.union_surface = all.share();
  Union frontal(probe.point_count(fruit.id));
  for (const Vec3& eye : frontal_positions(fruit.centre)) {
    const FruitView view = probe.view(fruit.id, eye);
    frontal.add(view);
    result.best_frontal_level = std::max(result.best_frontal_level, view.facing_share);
  }
  result.union_frontal = frontal.share();
  result.frontal = probe.view(fruit.id, Vec3(0.0, fruit.centre.y(), fruit.centre.z())).facing_share;
  return result;
}

std::vector<FruitVisibility> visibilities(
    const Scene& scene, const OcclusionProbe& probe, int limit,
    const std::function<std::vector<Vec3>(const FruitTruth&)>& eyes_of) {
  std::vector<const FruitTruth*> counted;
  for (const FruitTruth& fruit : scene.fruits) {
    if (fruit.counted) counted.push_back(&fruit);
  }
  const std::size_t count = std::min(counted.size(), static_cast<std::size_t>(limit));
  std::vector<FruitVisibility> result(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const FruitTruth& fruit = *counted[i * counted.size() / count];
    result[i] = visibility(probe, fruit, eyes_of(fruit));
  });
  return result;
}

}  // namespace canopeer
