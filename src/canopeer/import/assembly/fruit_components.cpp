#include "canopeer/import/assembly/fruit_components.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "canopeer/import/assembly/weld.h"

namespace canopeer {
namespace {

// A second moment this many times the next one marks a long axis: 1.25² for the lengths.
constexpr double kStandsOut = 1.5625;

/// Triangles of all pieces in a row, each with the set it hangs together with.
struct Shells {
  std::vector<std::uint32_t> shell_of;                ///< per triangle
  std::map<std::uint32_t, std::vector<Vec3>> points;  ///< per shell
  std::map<std::uint32_t, double> surface_m2;
};

Shells connect(std::span<const MeshPiece> pieces, double tolerance_m) {
  std::vector<Eigen::Vector3f> points;
  for (const MeshPiece& piece : pieces) {
    points.insert(points.end(), piece.mesh.vertices.begin(), piece.mesh.vertices.end());
  }
  const auto first = weld(points, tolerance_m);
  DisjointSets sets(points.size());
  std::uint32_t offset = 0;
  for (const MeshPiece& piece : pieces) {
    for (const auto& t : piece.mesh.triangles) {
      sets.join(first[t[0] + offset], first[t[1] + offset]);
      sets.join(first[t[0] + offset], first[t[2] + offset]);
    }
    offset += static_cast<std::uint32_t>(piece.mesh.vertices.size());
  }
  Shells shells;
  offset = 0;
  for (const MeshPiece& piece : pieces) {
    for (const auto& t : piece.mesh.triangles) {
      const std::uint32_t shell = sets.find(first[t[0] + offset]);
      shells.shell_of.push_back(shell);
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = points[t[k] + offset].cast<double>();
      auto& of_shell = shells.points[shell];
      of_shell.insert(of_shell.end(), p.begin(), p.end());
      shells.surface_m2[shell] += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    }
    offset += static_cast<std::uint32_t>(piece.mesh.vertices.size());
  }
  return shells;
}

struct Candidate {
  std::uint32_t shell = 0;
  std::optional<ConvexHull> hull;
  std::uint32_t owner = 0;  ///< index of the candidate it is part of; its own: none

  [[nodiscard]] double volume() const { return hull ? hull->volume_m3 : 0.0; }
};

bool inside(const std::vector<Vec3>& points, const ConvexHull& hull, double margin_m) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return hull.contains(p, margin_m); });
}

/// Gives each candidate that lies inside a larger one to that.
void nest(const Shells& shells, double margin_m, std::vector<Candidate>* candidates) {
  std::vector<std::uint32_t> by_volume(candidates->size());
  std::iota(by_volume.begin(), by_volume.end(), 0U);
  std::stable_sort(by_volume.begin(), by_volume.end(), [&](auto a, auto b) {
    return (*candidates)[a].volume() > (*candidates)[b].volume();
  });
  for (std::size_t i = 1; i < by_volume.size(); ++i) {
    Candidate& small = (*candidates)[by_volume[i]];
    const auto& points = shells.points.at(small.shell);
    for (std::size_t k = 0; k < i; ++k) {
      const Candidate& large = (*candidates)[by_volume[k]];
      if (large.owner != by_volume[k] || !large.hull) continue;
      if (!large.hull->contains(points.front(), margin_m)) continue;
      if (!inside(points, *large.hull, margin_m)) continue;
      small.owner = by_volume[k];
      break;
    }
  }
}

}  // namespace

FruitComponents find_fruits(std::span<const MeshPiece> pieces,
                            const FruitComponentOptions& options) {
  const Shells shells = connect(pieces, options.weld_tolerance_m);
  std::vector<Candidate> candidates;
  std::map<std::uint32_t, std::uint32_t> candidate_of;
  for (const std::uint32_t shell : shells.shell_of) {
    if (candidate_of.count(shell) != 0) continue;
    const auto index = static_cast<std::uint32_t>(candidates.size());
    candidate_of[shell] = index;
    candidates.push_back({shell, convex_hull(shells.points.at(shell)), index});
  }
  nest(shells, options.inside_margin_m, &candidates);

  FruitComponents result;
  std::vector<int> component(candidates.size(), -1);
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    if (c.owner != i) continue;
    if (c.volume() * 1e6 < options.min_hull_cm3) {
      ++result.scraps;
      continue;
    }
    component[i] = static_cast<int>(result.components.size());
    result.components.push_back({*c.hull, shells.surface_m2.at(c.shell)});
  }
  std::size_t triangle = 0;
  for (const MeshPiece& piece : pieces) {
    auto& of_piece = result.component_of.emplace_back();
    for (std::size_t i = 0; i < piece.mesh.triangles.size(); ++i) {
      const Candidate& c = candidates[candidate_of.at(shells.shell_of[triangle++])];
      of_piece.push_back(component[c.owner]);
    }
  }
  return result;
}

FruitSize measure_fruit(const ConvexHull& hull) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(hull.covariance);
  const Vec3 moments = solver.eigenvalues();  // increasing
  Vec3 axis = solver.eigenvectors().col(2);
  if (moments[2] < kStandsOut * moments[1]) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 other = solver.eigenvectors().col(k);
      if (std::abs(other.z()) > std::abs(axis.z())) axis = other;
    }
    // As good as round about a level line: upright is upright.
    if (moments[2] < 1.1 * moments[0]) axis = Vec3::UnitZ();
  }
  const auto extent = [&](const Vec3& direction) {
    double low = 1e300;
    double high = -1e300;
    for (const Vec3& p : hull.vertices) {
      low = std::min(low, direction.dot(p));
      high = std::max(high, direction.dot(p));
    }
    return high - low;
  };
  const Vec3 side = axis.unitOrthogonal();
  const Vec3 other = axis.cross(side);
  FruitSize size;
  size.length_m = extent(axis);
  for (int degree = 0; degree < 180; degree += 2) {
    const double angle = degree * std::numbers::pi / 180.0;
    size.diameter_m =
        std::max(size.diameter_m, extent(std::cos(angle) * side + std::sin(angle) * other));
  }
  return size;
}

}  // namespace canopeer
