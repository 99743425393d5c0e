#include "canopeer/bounds/visibility/fruit_cutting.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>
#include <utility>

namespace canopeer {
namespace {

constexpr double kSeedReach = 0.75;  // of patch_m: cells are then about as large as a patch

int fruit_of(const ScenePart& part, const SceneInstance* copy) {
  return part.fruit < 0 ? -1 : part.fruit + (copy == nullptr ? 0 : copy->first_fruit);
}

bool counted_body(const Scene& scene, const ScenePart& part, const SceneInstance* copy) {
  const int fruit = fruit_of(part, copy);
  return fruit >= 0 && !part.see_through && scene.fruits[static_cast<std::size_t>(fruit)].counted;
}

/// Halves triangles at their longest edges until none is longer than `longest_m`. Neighbours halve
/// a common edge at the same point.
void refine(TriangleMesh& mesh, double longest_m) {
  const auto limit2 = static_cast<float>(longest_m * longest_m);
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [at, fresh] = middles.emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (fresh) mesh.vertices.push_back(0.5F * (mesh.vertices[a] + mesh.vertices[b]));
    return at->second;
  };
  for (std::size_t i = 0; i < mesh.triangles.size();) {
    const auto t = mesh.triangles[i];
    std::size_t longest = 0;
    std::array<float, 3> length2{};
    for (std::size_t k = 0; k < 3; ++k) {
      length2[k] = (mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]]).squaredNorm();
      if (length2[k] > length2[longest]) longest = k;
    }
    if (length2[longest] <= limit2) {
      ++i;
      continue;
    }
    const std::uint32_t a = t[longest];
    const std::uint32_t b = t[(longest + 1) % 3];
    const std::uint32_t c = t[(longest + 2) % 3];
    const std::uint32_t m = middle_of(a, b);
    mesh.triangles[i] = {a, m, c};
    mesh.triangles.push_back({m, b, c});
  }
}

ScenePart body_in_world(const ScenePart& part, const Pose& T, double patch_m) {
  ScenePart body;
  body.mesh.append(part.mesh, T);
  body.kind = PartClass::fruit;
  body.fruit = -1;  // its number is another
  if (part.texture != nullptr && part.texture->cuts()) {
    body.texture = part.texture;  // with holes: as it is
    body.uv = part.uv;
  } else {
    body.mesh.normals.clear();
    refine(body.mesh, patch_m);
  }
  return body;
}

/// Of each triangle the number of its cell, from 0.
std::vector<std::uint32_t> cells_of_mesh(const TriangleMesh& mesh, double patch_m) {
  std::vector<Eigen::Vector3f> centres;
  centres.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    centres.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0F);
  }
  const auto reach2 = static_cast<float>(kSeedReach * kSeedReach * patch_m * patch_m);
  std::vector<float> distance2(centres.size(), std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> cell(centres.size(), 0);
  std::size_t seed = 0;
  for (std::uint32_t number = 0; number < centres.size(); ++number) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const float d2 = (centres[i] - centres[seed]).squaredNorm();
      if (d2 < distance2[i]) {
        distance2[i] = d2;
        cell[i] = number;
      }
      if (distance2[i] > distance2[farthest]) farthest = i;
    }
    if (distance2[farthest] <= reach2) break;
    seed = farthest;
  }
  return cell;
}

double area_cm2_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = mesh.vertices[t[0]].cast<double>();
  const Vec3 b = mesh.vertices[t[1]].cast<double>();
  const Vec3 c = mesh.vertices[t[2]].cast<double>();
  return 0.5 * (b - a).cross(c - a).norm() * 1e4;
}

Vec3 middle_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return ((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0F).cast<double>();
}

/// The part's triangles that reach into the box; empty when there are none.
NumberedPart part_near(const ScenePart& part, const Pose& T, const Box& box) {
  NumberedPart near;
  const Eigen::Isometry3f T_float = T.cast<float>();
  const bool holes = part.texture != nullptr && part.texture->cuts() &&
                     part.uv.size() == part.mesh.vertices.size();
  std::vector<std::uint32_t> moved(part.mesh.vertices.size(), NumberedPart::kNone);
  TriangleMesh& mesh = near.part.mesh;
  for (const auto& t : part.mesh.triangles) {
    Box around;
    for (const std::uint32_t v : t) {
      around.extend((T_float * part.mesh.vertices[v]).cast<double>());
    }
    if (!box.intersects(around)) continue;
    mesh.triangles.push_back({});
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& at = moved[t[k]];
      if (at == NumberedPart::kNone) {
        at = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(T_float * part.mesh.vertices[t[k]]);
        if (holes) near.part.uv.push_back(part.uv[t[k]]);
      }
      mesh.triangles.back()[k] = at;
    }
  }
  if (holes) near.part.texture = part.texture;
  near.part.kind = part.kind;
  return near;
}

}  // namespace

CutFruits cut_fruits(const Scene& scene, double patch_m) {
  CutFruits cut;
  FruitPatches& patches = cut.patches;
  patches.patch_m = patch_m;
  patches.fruits_total = scene.counted_fruits();
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
    if (!counted_body(scene, part, copy) || part.mesh.triangles.empty()) return;
    NumberedPart body{body_in_world(part, T, patch_m), {}};
    const std::vector<std::uint32_t> cell = cells_of_mesh(body.part.mesh, patch_m);
    const auto first = static_cast<std::uint32_t>(patches.fruit.size());
    const std::uint32_t cells = *std::max_element(cell.begin(), cell.end()) + 1;
    patches.fruit.resize(first + cells, fruit_of(part, copy));
    cut.points.resize(first + cells);
    std::vector<double> area(cells, 0.0);
    for (std::size_t i = 0; i < cell.size(); ++i) {
      area[cell[i]] += area_cm2_of(body.part.mesh, body.part.mesh.triangles[i]);
      body.numbers.push_back(first + cell[i]);
      cut.points[first + cell[i]].push_back(middle_of(body.part.mesh, body.part.mesh.triangles[i]));
    }
    for (const double a : area) {
      patches.area_cm2.push_back(static_cast<float>(a));
      patches.area_total_cm2 += a;
    }
    cut.bodies.push_back(std::move(body));
  });
  return cut;
}

std::vector<NumberedPart> what_else_is_near(const Scene& scene, const Box& box_world) {
  std::vector<NumberedPart> near;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
    if (part.see_through || counted_body(scene, part, copy)) return;
    if (!box_world.intersects(transformed(part.mesh.bounds(), T))) return;
    NumberedPart found = part_near(part, T, box_world);
    if (!found.part.mesh.triangles.empty()) near.push_back(std::move(found));
  });
  return near;
}

}  // namespace canopeer
