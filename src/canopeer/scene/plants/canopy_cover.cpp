#include "canopeer/scene/plants/canopy_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace canopeer {
namespace {

constexpr double kFar = 0.45;  // leaves beyond are those of the next plant
/// Points of a body's outline and middle, across and up, in radii.
constexpr std::array<std::array<double, 2>, 9> kPoints = {{{0.0, 0.0},
                                                           {0.7, 0.0},
                                                           {-0.7, 0.0},
                                                           {0.0, 0.7},
                                                           {0.0, -0.7},
                                                           {0.5, 0.5},
                                                           {0.5, -0.5},
                                                           {-0.5, 0.5},
                                                           {-0.5, -0.5}}};

}  // namespace

/// Does the blade reach into the ball? Such a leaf will have to turn away.
bool CanopyCover::touches(const Ellipse& blade, const Vec3& centre, double radius_m) {
  const Vec3 d = centre - blade.centre;
  const double height = d.dot(blade.normal);
  if (std::abs(height) > radius_m) return false;
  // Grown by the ball's section at the blade's plane.
  const double grow = std::sqrt(radius_m * radius_m - height * height);
  const double a = d.dot(blade.along) / (1.0 + grow * blade.along.norm());
  const double b = d.dot(blade.across) / (1.0 + grow * blade.across.norm());
  return a * a + b * b < 1.0;
}

CanopyCover::CanopyCover(const std::vector<PlacedLeaf>& leaves) {
  for (const PlacedLeaf& leaf : leaves) {
    const TriangleMesh blade = make_blade(leaf.form, petiole_end(leaf.form, leaf.node));
    const Vec3 base = blade.vertices.front().cast<double>();
    const Vec3 tip = blade.vertices.back().cast<double>();
    Vec3 middle = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0; i < blade.vertices.size(); ++i) {
      middle += blade.vertices[i].cast<double>();
      normal += blade.normals[i].cast<double>();
    }
    middle /= static_cast<double>(blade.vertices.size());
    const Vec3 along = (tip - base).normalized();
    normal = (normal - normal.dot(along) * along).normalized();
    const double half_length = 0.5 * (tip - base).norm();
    const double half_width = 0.45 * leaf.form.width_m;
    blades_.push_back({middle, along / half_length, normal.cross(along) / half_width, normal,
                       std::max(half_length, half_width)});
  }
}

double CanopyCover::shown(const std::vector<const Ellipse*>& near, const Vec3& centre,
                          double radius_m, const Vec3& towards) const {
  const Vec3 across(-towards.y(), towards.x(), 0.0);
  int free = 0;
  for (const auto& [y, z] : kPoints) {
    const Vec3 start = centre + radius_m * (y * across + z * Vec3::UnitZ());
    free += std::none_of(near.begin(), near.end(), [&](const Ellipse* blade) {
      const double slope = towards.dot(blade->normal);
      if (std::abs(slope) < 1e-6) return false;
      const double t = (blade->centre - start).dot(blade->normal) / slope;
      if (t < 0.0 || t > kFar) return false;
      const Vec3 d = start + t * towards - blade->centre;
      const double a = d.dot(blade->along);
      const double b = d.dot(blade->across);
      return a * a + b * b < 1.0;
    });
  }
  return free / static_cast<double>(kPoints.size());
}

double CanopyCover::shown_level(const Vec3& centre, double radius_m) const {
  std::vector<const Ellipse*> near;
  for (const Ellipse& blade : blades_) {
    const double reach = blade.reach_m + radius_m;
    const bool level = std::abs(blade.centre.z() - centre.z()) < reach;
    if (!level || (blade.centre - centre).norm() > kFar + reach) continue;
    if (!touches(blade, centre, radius_m + 0.01)) near.push_back(&blade);
  }
  double most = 0.0;
  for (const double side : {-1.0, 1.0}) {
    for (int k = -3; k <= 3; ++k) {
      const double angle = k * std::numbers::pi / 18.0;
      const Vec3 towards(side * std::cos(angle), std::sin(angle), 0.0);
      most = std::max(most, shown(near, centre, radius_m, towards));
    }
  }
  return most;
}

}  // namespace canopeer
