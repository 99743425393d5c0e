#include "canopeer/replay/frames/surface_frames.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "canopeer/base/byte_order.h"
#include "canopeer/replay/frames/frame_head.h"

namespace canopeer::frames {
namespace {

constexpr std::size_t kMostPoints = 400;  // of a fruit
constexpr double kStep = 1e-4;            // m

using Vertices = std::vector<std::uint32_t>;

std::map<int, Vertices> by_fruit(const SurfaceMesh& mesh) {
  std::map<int, Vertices> fruits;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.fruit[i] >= 0) fruits[mesh.fruit[i]].push_back(static_cast<std::uint32_t>(i));
  }
  return fruits;
}

/// At most so many, evenly among all; neighbours in the list are neighbours on the surface.
Vertices thinned(const Vertices& all) {
  const std::size_t count = std::min(all.size(), kMostPoints);
  Vertices some(count);
  for (std::size_t i = 0; i < count; ++i) some[i] = all[i * all.size() / count];
  return some;
}

Vec3 mean_of(const SurfaceMesh& mesh, const Vertices& vertices) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t v : vertices) sum += mesh.vertices[v].surface.point;
  return sum / static_cast<double>(vertices.size());
}

std::uint64_t fingerprint(const std::string& octets, const Vec3& origin) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto mix = [&](std::uint64_t value) { hash = (hash ^ value) * 1099511628211ULL; };
  for (const char c : octets) mix(static_cast<unsigned char>(c));
  for (int i = 0; i < 3; ++i) mix(static_cast<std::uint64_t>(std::llround(origin[i] / kStep)));
  return hash;
}

}  // namespace

std::vector<Frame> SurfaceFrames::surface(double t_s, const SurfaceMesh& mesh) {
  Json fruits = Json::array();
  std::string all;
  for (const auto& [id, vertices] : by_fruit(mesh)) {
    const Vertices some = thinned(vertices);
    Vec3 origin = mean_of(mesh, some);
    for (int i = 0; i < 3; ++i) origin[i] = rounded(origin[i], kStep);
    std::string octets;
    for (const std::uint32_t v : some) {
      const Vec3 from_origin = mesh.vertices[v].surface.point - origin;
      for (int i = 0; i < 3; ++i) {
        const double steps = std::clamp(from_origin[i] / kStep, -32767.0, 32767.0);
        append_number(octets, static_cast<std::int16_t>(std::lround(steps)));
      }
    }
    const std::uint64_t now = fingerprint(octets, origin);
    if (const auto told = told_.find(id); told != told_.end() && told->second == now) continue;
    told_[id] = now;
    fruits.push_back({{"id", id}, {"origin", from(origin)}, {"points", some.size()}});
    all += octets;
  }
  if (fruits.empty()) return {};
  Json head = head_of("surface");
  head["t_s"] = from_time(t_s);
  head["fruits"] = std::move(fruits);
  return {frame_of(head, std::move(all))};
}

}  // namespace canopeer::frames
