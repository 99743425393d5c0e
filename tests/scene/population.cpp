#include "population.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/scene/plants/fruit_body.h"

namespace canopeer::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kPlot = 0.25;   // m², ground of a measured plant
constexpr double kLayer = 0.10;  // m

Vec3 area_vector(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Eigen::Vector3f a = mesh.vertices[t[1]] - mesh.vertices[t[0]];
  const Eigen::Vector3f b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
  return 0.5 * a.cross(b).cast<double>();
}

double from_vertical_deg(const Vec3& n) {
  return std::acos(std::clamp(std::abs(n.normalized().z()), 0.0, 1.0)) / kDegree;
}

struct Measuring {
  Population p;
  double area = 0.0;
  double area_angle = 0.0;

  void leaf(const PlacedLeaf& leaf, const TriangleMesh& blade, std::array<double, kLayers>* layers);
  void fruit(const Plant& plant, std::size_t i);
};

void Measuring::leaf(const PlacedLeaf& leaf, const TriangleMesh& blade,
                     std::array<double, kLayers>* layers) {
  std::array<double, kAngleBins> bins{};
  Vec3 sum = Vec3::Zero();
  double leaf_area = 0.0;
  for (const auto& t : blade.triangles) {
    const Vec3 n = area_vector(blade, t);
    const double a = n.norm();
    if (a <= 0.0) continue;
    const double angle = from_vertical_deg(n);
    bins[static_cast<std::size_t>(std::min(kAngleBins - 1, static_cast<int>(angle / 10.0)))] += a;
    area_angle += a * angle;
    leaf_area += a;
    sum += n;
    const double z =
        (blade.vertices[t[0]].z() + blade.vertices[t[1]].z() + blade.vertices[t[2]].z()) / 3.0;
    const int layer = static_cast<int>(std::floor(z / kLayer));
    if (layer >= 0 && layer < kLayers) (*layers)[static_cast<std::size_t>(layer)] += a;
  }
  area += leaf_area;
  double deviation = 0.0;
  for (const auto& t : blade.triangles) {
    const Vec3 n = area_vector(blade, t);
    if (n.norm() <= 0.0) continue;
    deviation += n.norm() * std::acos(std::clamp(n.normalized().dot(sum.normalized()), -1.0, 1.0));
  }
  for (std::size_t b = 0; b < bins.size(); ++b) {
    p.angle_share[b] += bins[b];
    p.angle_share_of_leaf[b].add(bins[b] / leaf_area);
  }
  p.width_to_length.add(leaf.form.width_m / leaf.form.length_m);
  p.blade_area_share.add(leaf_area / (leaf.form.width_m * leaf.form.length_m));
  p.chord_to_arc.add((blade.vertices.back() - blade.vertices.front()).cast<double>().norm() /
                     leaf.form.length_m);
  p.normal_deviation_deg.add(deviation / leaf_area / kDegree);
  const auto row = std::find_if(kTipRows.begin(), kTipRows.end(),
                                [&](double upper) { return leaf.below_tip_m < upper; });
  if (row == kTipRows.end()) return;
  LeafSamples& s = p.leaves[static_cast<std::size_t>(row - kTipRows.begin())];
  s.length_cm.add(100.0 * leaf.form.length_m);
  s.width_cm.add(100.0 * leaf.form.width_m);
  s.petiole_cm.add(100.0 * leaf.form.petiole_m);
  s.petiole_pitch_deg.add(leaf.form.petiole_pitch_rad / kDegree);
  // As on the measured meshes: of the line from the blade's base to its tip.
  const Vec3 chord = (blade.vertices.back() - blade.vertices.front()).cast<double>();
  s.blade_pitch_deg.add(std::asin(std::clamp(chord.normalized().z(), -1.0, 1.0)) / kDegree);
  s.normal_deg.add(from_vertical_deg(sum));
  s.area_cm2.add(1e4 * leaf_area);
}

void Measuring::fruit(const Plant& plant, std::size_t i) {
  const HangingFruit& f = plant.hanging[i];
  const Vec3 centre = f.T_plant_fruit.translation();
  ++p.fruits;
  p.minus_x_fruits += centre.x() < 0.0;
  p.fruit_height_m.add(centre.z());
  p.shoot_distance_cm.add(100.0 * distance_to_shoots(plant.shoots, centre));
  p.tilt_deg.add(std::acos(std::clamp(f.T_plant_fruit.linear()(2, 2), -1.0, 1.0)) / kDegree);
  double nearest = 1e9;
  for (std::size_t k = 0; k < plant.hanging.size(); ++k) {
    if (k != i)
      nearest = std::min(nearest, (plant.hanging[k].T_plant_fruit.translation() - centre).norm());
  }
  if (plant.hanging.size() > 1) p.neighbour_cm.add(100.0 * nearest);
  if (f.ripeness == Ripeness::green) {
    p.green_length_mm.add(1e3 * f.form.length_m);
    p.green_diameter_mm.add(1e3 * f.form.diameter_m);
    return;
  }
  p.length_mm.add(1e3 * f.form.length_m);
  p.diameter_mm.add(1e3 * f.form.diameter_m);
  p.narrow_mm.add(1e3 * f.form.narrow_m);
  p.hull_cm3.add(plant.fruits[i].volume_cm3 / 0.9);
}

}  // namespace

double Sample::mean() const {
  double sum = 0.0;
  for (const double v : values_) sum += v;
  return sum / static_cast<double>(values_.size());
}

double Sample::sd() const {
  const double m = mean();
  double sum = 0.0;
  for (const double v : values_) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(values_.size()));
}

double Sample::quantile(double rank) const {
  std::vector<double> sorted = values_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(rank * static_cast<double>(sorted.size() - 1))];
}

Population grow_population(int each) {
  Measuring m;
  for (int kind = 3; kind <= 9; ++kind) {
    for (int i = 0; i < each; ++i) {
      Rng rng(static_cast<std::uint64_t>(i), "population", static_cast<std::uint64_t>(kind));
      const Plant plant = grow_plant(plant_kind(kind), rng);
      Box box;
      for (const ScenePart& part : plant.parts) box.extend(part.mesh.bounds());
      m.p.height_m[kind].add(box.max().z());
      m.p.leaf_count[kind].add(static_cast<double>(plant.leaves.size()));
      for (std::size_t f = 0; f < plant.hanging.size(); ++f) m.fruit(plant, f);
      if (kind > 6) continue;
      std::array<double, kLayers> layers{};
      std::size_t leaf = 0;
      double area = 0.0;
      for (const ScenePart& part : plant.parts) {
        if (part.kind != PartClass::leaf) continue;
        m.leaf(plant.leaves[leaf++], part.mesh, &layers);
        area += part.mesh.area();
      }
      m.p.leaf_area_m2[kind].add(area);
      for (std::size_t l = 0; l < layers.size(); ++l)
        m.p.density_m2_m3[kind][l].add(layers[l] / (kPlot * kLayer));
    }
  }
  for (double& share : m.p.angle_share) share /= m.area;
  m.p.mean_angle_deg = m.area_angle / m.area;
  return m.p;
}

}  // namespace canopeer::test
