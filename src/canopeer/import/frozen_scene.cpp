#include "canopeer/import/frozen_scene.h"

#include <vector>

#include "canopeer/import/assembly/fruit_components.h"

namespace canopeer {
namespace {

/// All surfaces of a fruit as one mesh, world frame.
std::vector<TriangleMesh> fruit_bodies(const Scene& scene) {
  std::vector<TriangleMesh> bodies(scene.fruits.size());
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
    if (part.fruit < 0) return;
    const int id = part.fruit + (copy == nullptr ? 0 : copy->first_fruit);
    bodies[static_cast<std::size_t>(id)].append(part.mesh, T);
  });
  return bodies;
}

/// Of a closed body, by the divergence theorem.
Vec3 centroid(const TriangleMesh& body) {
  const Vec3 origin = body.vertices.front().cast<double>();
  Vec3 moment = Vec3::Zero();
  double six_volumes = 0.0;
  for (const auto& t : body.triangles) {
    const Vec3 a = body.vertices[t[0]].cast<double>() - origin;
    const Vec3 b = body.vertices[t[1]].cast<double>() - origin;
    const Vec3 c = body.vertices[t[2]].cast<double>() - origin;
    const double six = a.dot(b.cross(c));
    six_volumes += six;
    moment += six * (a + b + c) / 4.0;
  }
  return origin + moment / six_volumes;
}

void measure_closed(const TriangleMesh& body, FruitTruth& fruit) {
  if (!(body.volume() > 0.0)) return;
  fruit.centre = centroid(body);
  fruit.volume_cm3 = body.volume() * 1e6;
  fruit.surface_cm2 = body.area() * 1e4;
}

void measure_hull(const TriangleMesh& body, FruitTruth& fruit) {
  std::vector<Vec3> points;
  for (const auto& v : body.vertices) points.push_back(v.cast<double>());
  const auto hull = convex_hull(points);
  if (!hull) return;
  const FruitSize size = measure_fruit(*hull);
  fruit.centre = hull->centroid;
  fruit.length_m = size.length_m;
  fruit.diameter_m = size.diameter_m;
  fruit.volume_cm3 = hull->volume_m3 * 1e6;
  fruit.surface_cm2 = body.area() * 1e4;
}

}  // namespace

Expected<Scene> frozen_scene(const Scene& scene, const SceneFileOptions& options) {
  const auto bytes = scene_bytes(scene, options);
  if (!bytes) return tl::unexpected(bytes.error());
  auto frozen = parse_scene(*bytes);
  if (!frozen) return frozen;
  const std::vector<TriangleMesh> bodies = fruit_bodies(*frozen);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].vertices.empty()) continue;
    (frozen->imported ? measure_hull : measure_closed)(bodies[i], frozen->fruits[i]);
  }
  return frozen;
}

}  // namespace canopeer
