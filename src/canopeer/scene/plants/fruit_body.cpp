#include "canopeer/scene/plants/fruit_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/geometry/angles.h"
#include "canopeer/scene/plants/statistics.h"

namespace canopeer {
namespace {

constexpr int kRings = 22;  // between the poles
constexpr int kSides = 32;
constexpr double kBlockiness = 1.0;  // exponent of the profile: 1 is an ellipse, 0 a rectangle
constexpr double kTopDent = 0.17;    // depth at the axis, half lengths
constexpr double kLowDent = 0.10;

// 34 measured fruits; the sizes of one fruit go together.
constexpr std::array<Quantile, 5> kLength = {
    {{0.0, 0.056}, {0.05, 0.062}, {0.5, 0.074}, {0.95, 0.090}, {1.0, 0.095}}};
constexpr std::array<Quantile, 5> kDiameter = {
    {{0.0, 0.047}, {0.05, 0.051}, {0.5, 0.069}, {0.95, 0.085}, {1.0, 0.090}}};
constexpr std::array<Quantile, 5> kNarrow = {
    {{0.0, 0.041}, {0.05, 0.044}, {0.5, 0.059}, {0.95, 0.075}, {1.0, 0.079}}};
constexpr std::array<Quantile, 3> kGreenLength = {{{0.05, 0.038}, {0.5, 0.055}, {0.95, 0.057}}};
constexpr std::array<Quantile, 3> kGreenDiameter = {{{0.05, 0.026}, {0.5, 0.046}, {0.95, 0.052}}};

/// Radius at (polar angle, azimuth) over the mean radius, and height over the half length, before
/// the body is scaled to its form.
Vec3 unit_point(const FruitForm& form, double polar, double azimuth) {
  const double c = std::cos(polar);
  const double s = std::max(0.0, std::sin(polar));
  double radius = std::pow(s, kBlockiness);
  double z = std::copysign(std::pow(std::abs(c), kBlockiness), c);
  // Narrow grooves between round lobes, deeper towards the ends.
  const double groove =
      1.0 - std::abs(std::sin(0.5 * form.lobes * (azimuth - form.lobe_phase_rad)));
  radius *= 1.0 - form.lobe_depth * (0.6 + 0.6 * z * z) * std::pow(groove, 1.3);
  radius *= 1.0 - form.taper * 0.5 * (1.0 - z) + 0.25 * form.taper * z * z;
  const double near_axis = std::exp(-radius * radius / 0.16);
  z -= c > 0.0 ? kTopDent * near_axis : -kLowDent * near_axis;
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// Largest width of the body across z over directions 5° apart.
double largest_width(const std::vector<Vec3>& points) {
  double largest = 0.0;
  for (int i = 0; i < 36; ++i) {
    const Vec3 d(std::cos(kPi * i / 36.0), std::sin(kPi * i / 36.0), 0.0);
    double low = 0.0;
    double high = 0.0;
    for (const Vec3& p : points) {
      low = std::min(low, p.dot(d));
      high = std::max(high, p.dot(d));
    }
    largest = std::max(largest, high - low);
  }
  return largest;
}

std::vector<Vec3> body_points(const FruitForm& form) {
  std::vector<Vec3> points;
  for (int i = 0; i <= kRings + 1; ++i) {
    const double polar = kPi * i / (kRings + 1);
    const int sides = i == 0 || i == kRings + 1 ? 1 : kSides;
    for (int k = 0; k < sides; ++k)
      points.push_back(unit_point(form, polar, 2.0 * kPi * k / kSides));
  }
  return points;
}

/// Scales and centres the unit body to the form's extents.
void fit(const FruitForm& form, std::vector<Vec3>* points) {
  const double squash = form.narrow_m / form.diameter_m;
  for (Vec3& p : *points) p.y() *= squash;
  double low = 0.0;
  double high = 0.0;
  for (const Vec3& p : *points) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  const double across = form.diameter_m / largest_width(*points);
  const double along = form.length_m / (high - low);
  for (Vec3& p : *points) {
    p = Vec3(across * p.x(), across * p.y(), along * (p.z() - 0.5 * (low + high)));
  }
}

}  // namespace

FruitForm draw_fruit(Ripeness ripeness, Rng& rng) {
  FruitForm form;
  const double rank = rng.uniform();
  const auto near_rank = [&] { return std::clamp(rank + rng.uniform(-0.3, 0.3), 0.0, 1.0); };
  if (ripeness == Ripeness::green) {
    form.length_m = value_at_rank(kGreenLength, near_rank());
    form.diameter_m = std::min(value_at_rank(kGreenDiameter, near_rank()), form.length_m);
    form.narrow_m = 0.88 * form.diameter_m;
  } else {
    form.length_m = value_at_rank(kLength, near_rank());
    form.diameter_m = value_at_rank(kDiameter, near_rank());
    form.narrow_m =
        std::clamp(value_at_rank(kNarrow, near_rank()), 0.75 * form.diameter_m, form.diameter_m);
  }
  form.lobes = rng.chance(0.45) ? 3 : 4;
  form.lobe_depth = rng.uniform(0.20, 0.34);
  form.taper = rng.uniform(0.15, 0.32);
  form.lobe_phase_rad = rng.uniform(0.0, 2.0 * kPi);
  return form;
}

TriangleMesh make_fruit_body(const FruitForm& form) {
  std::vector<Vec3> points = body_points(form);
  fit(form, &points);
  TriangleMesh mesh;
  for (const Vec3& p : points) mesh.vertices.emplace_back(p.cast<float>());
  const auto n = static_cast<std::uint32_t>(kSides);
  const auto last = static_cast<std::uint32_t>(points.size() - 1);
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    mesh.triangles.push_back({0, 1 + k, 1 + next});
    for (std::uint32_t i = 0; i + 1 < kRings; ++i) {
      const std::uint32_t ring = 1 + i * n;
      mesh.triangles.push_back({ring + k, ring + n + k, ring + n + next});
      mesh.triangles.push_back({ring + k, ring + n + next, ring + next});
    }
    mesh.triangles.push_back({last, last - n + next, last - n + k});
  }
  compute_normals(mesh);
  return mesh;
}

double fruit_top_m(const FruitForm& form) {
  std::vector<Vec3> points = body_points(form);
  fit(form, &points);
  return points.front().z();
}

TriangleMesh make_calyx(const FruitForm& form) {
  constexpr int kSepals = 6;
  const double reach = 0.24 * form.diameter_m;
  const double thickness = 0.0015;
  const double top = fruit_top_m(form);
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0F, 0.0F, static_cast<float>(top + 0.006));
  mesh.vertices.emplace_back(0.0F, 0.0F, static_cast<float>(top - 0.002));
  for (int k = 0; k < 2 * kSepals; ++k) {
    const double angle = kPi * k / kSepals;
    const double r = k % 2 == 0 ? reach : 0.5 * reach;
    // The sepals follow the rising shoulder around the dent.
    const double z = top + 0.5 * kTopDent * form.length_m * (r / reach) * 0.9 + thickness;
    mesh.vertices.push_back(Vec3(r * std::cos(angle), r * std::sin(angle), z).cast<float>());
  }
  const std::uint32_t n = 2 * kSepals;
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    mesh.triangles.push_back({0, 2 + k, 2 + next});
    mesh.triangles.push_back({1, 2 + next, 2 + k});
  }
  compute_normals(mesh);
  return mesh;
}

void measure_body(const TriangleMesh& body, FruitTruth* fruit) {
  // Sum over the tetrahedra between a vertex of the body and each triangle.
  const Vec3 origin = body.vertices.front().cast<double>();
  double six_volumes = 0.0;
  Vec3 weighted = Vec3::Zero();
  for (const auto& t : body.triangles) {
    const Vec3 a = body.vertices[t[0]].cast<double>() - origin;
    const Vec3 b = body.vertices[t[1]].cast<double>() - origin;
    const Vec3 c = body.vertices[t[2]].cast<double>() - origin;
    const double v = a.dot(b.cross(c));
    six_volumes += v;
    weighted += v * (a + b + c) / 4.0;
  }
  fruit->centre = origin + weighted / six_volumes;
  fruit->volume_cm3 = six_volumes / 6.0 * 1e6;
  fruit->surface_cm2 = body.area() * 1e4;
}

}  // namespace canopeer
