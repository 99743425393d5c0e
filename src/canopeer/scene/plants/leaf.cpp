#include "canopeer/scene/plants/leaf.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/geometry/angles.h"
#include "canopeer/scene/plants/statistics.h"
#include "canopeer/scene/plants/tube.h"

namespace canopeer {
namespace {

constexpr int kAlong = 10;  // quads along the blade
constexpr int kAcross = 6;  // and across it, even: one edge is the midrib

/// Leaves by distance below the shoot's tip, measured on 186 leaves of plants 3–6.
struct LeafRow {
  double below_tip_m;  // upper end of the row's range
  double length_cm, length_sd_cm;
  double petiole_cm;
  double petiole_pitch_deg;
  double blade_pitch_deg, blade_pitch_sd_deg;
};
constexpr std::array<LeafRow, 9> kLeafRows = {{
    {0.02, 3.5, 2.1, 1.1, 66, 49, 27},
    {0.05, 6.6, 2.7, 2.3, 48, 10, 19},
    {0.08, 7.8, 3.1, 2.7, 48, 17, 35},
    {0.12, 8.9, 3.4, 3.1, 35, 1, 38},
    {0.20, 9.6, 3.7, 3.4, 31, -4, 31},
    {0.30, 16.4, 1.3, 6.6, 32, -20, 23},
    {0.40, 16.3, 2.4, 6.5, 12, -37, 23},
    {0.55, 17.1, 2.5, 6.9, 3, -43, 19},
    {10.0, 16.4, 2.6, 7.0, -6, -50, 19},
}};

const LeafRow& row_for(double below_tip_m) {
  return *std::find_if(kLeafRows.begin(), kLeafRows.end() - 1,
                       [&](const LeafRow& row) { return below_tip_m < row.below_tip_m; });
}

/// Roll from a standard normal deviate. The youngest leaves stand on edge about the tip; of the old
/// ones most lie level across and a few hang on edge, as the shares of steep leaf area show.
double roll_of(double below_tip_m, double x) {
  if (below_tip_m < 0.02) return 0.8 * x;
  if (below_tip_m < 0.12) return 0.45 * x;
  return below_tip_m < 0.3 ? 0.15 * x : 0.10 * x * (1.0 + 1.0 * x * x);
}

/// What must vary beside the two lengths of a pair for both together to have the relative standard
/// deviation `total`.
double pair_spread(double total, double ratio) {
  const double half_difference = (1.0 - ratio) / (1.0 + ratio);
  const double pair = half_difference * half_difference;
  return std::sqrt(std::max(0.0025, (total * total - pair) / (1.0 + pair)));
}

/// Half width over half the largest width at share t of the midrib: ovate, round at the base,
/// pointed at the tip, so that the blade's area is 0.73 · length · width.
double outline(double t) {
  constexpr double kWidest = 0.40;
  if (t < kWidest) return std::pow(1.0 - std::pow(1.0 - t / kWidest, 2.4), 0.6);
  const double s = (t - kWidest) / (1.0 - kWidest);
  return 1.0 - s * s;
}

Vec3 direction(double azimuth, double pitch) {
  return {std::cos(pitch) * std::cos(azimuth), std::cos(pitch) * std::sin(azimuth),
          std::sin(pitch)};
}

double base_pitch(const LeafForm& leaf) { return leaf.blade_pitch_rad + 0.5 * leaf.bend_rad; }

/// Height of the sheet over the midrib's tangent plane at lateral position a (−1 … 1), in half
/// widths.
double lift(const LeafForm& leaf, double t, double a) {
  const double ripple =
      0.07 * std::sin(5.0 * kPi * t + leaf.ripple_phase_rad + (a > 0 ? 0.0 : 1.7));
  return std::sin(leaf.fold_rad) * std::abs(a) + (ripple - leaf.cup) * a * a;
}

/// Axes of the sheet at a point of the midrib.
struct Frame {
  Vec3 origin, side, up;
};

Frame blade_frame(const LeafForm& leaf, const Vec3& base, double t) {
  // Integral of the midrib's direction, whose pitch falls evenly from base to tip.
  const double p0 = base_pitch(leaf);
  const double p = p0 - leaf.bend_rad * t;
  const double out = (std::sin(p0) - std::sin(p)) / leaf.bend_rad;
  const double up = (std::cos(p) - std::cos(p0)) / leaf.bend_rad;
  const Vec3 level(std::cos(leaf.azimuth_rad), std::sin(leaf.azimuth_rad), 0.0);
  const Vec3 along = direction(leaf.azimuth_rad, p);
  const double roll = leaf.roll_rad + leaf.twist_rad * (t - 0.5);
  Frame frame;
  frame.origin = base + leaf.length_m * (out * level + up * Vec3::UnitZ());
  frame.side = Eigen::AngleAxisd(roll, along) * Vec3(-level.y(), level.x(), 0.0);
  frame.up = along.cross(frame.side);
  return frame;
}

}  // namespace

LeafForm draw_leaf(double below_tip_m, bool in_pair, bool second, Rng& rng) {
  const LeafRow& row = row_for(below_tip_m);
  LeafForm leaf;
  if (in_pair) {
    // The table's mean is over both leaves of a pair, lengths 1 : 0.45.
    constexpr double kRatio = 0.45;
    const double first_cm = row.length_cm / (0.5 + 0.5 * kRatio);
    const double sd = pair_spread(row.length_sd_cm / row.length_cm, kRatio);
    leaf.length_m = 0.01 * first_cm * (second ? kRatio : 1.0) *
                    clipped_normal(rng, 1.0, sd, 1.0 - 2.0 * sd, 1.0 + 2.0 * sd);
  } else {
    leaf.length_m = 0.01 * clipped_normal(rng, row.length_cm, row.length_sd_cm,
                                          row.length_cm - 2.0 * row.length_sd_cm,
                                          row.length_cm + 2.0 * row.length_sd_cm);
  }
  leaf.width_m = leaf.length_m * clipped_normal(rng, 0.59, 0.07, 0.45, 0.75);
  leaf.petiole_m =
      leaf.length_m * row.petiole_cm / row.length_cm * clipped_normal(rng, 1.0, 0.15, 0.6, 1.4);
  // The small leaf of a pair points up; the table's mean is over both.
  const double up = !in_pair ? 0.0 : second ? 12.5 : -12.5;
  leaf.petiole_pitch_rad =
      kDegree * std::clamp(row.petiole_pitch_deg + up + rng.normal(0.0, 12.0), -45.0, 85.0);
  leaf.blade_pitch_rad =
      kDegree * clipped_normal(rng, row.blade_pitch_deg + up, row.blade_pitch_sd_deg, -85.0, 80.0);
  leaf.bend_rad = clipped_normal(rng, 1.47, 0.25, 0.80, 2.10);
  leaf.roll_rad = roll_of(below_tip_m, rng.normal(0.0, 1.0));
  leaf.twist_rad = rng.normal(0.0, 0.32);
  leaf.fold_rad = clipped_normal(rng, 0.21, 0.12, -0.1, 0.6);
  leaf.cup = clipped_normal(rng, 0.12, 0.10, -0.1, 0.35);
  leaf.ripple_phase_rad = rng.uniform(0.0, 2.0 * kPi);
  return leaf;
}

Vec3 petiole_end(const LeafForm& leaf, const Vec3& node) {
  return node + leaf.petiole_m * direction(leaf.azimuth_rad, leaf.petiole_pitch_rad);
}

TriangleMesh make_blade(const LeafForm& leaf, const Vec3& base) {
  TriangleMesh mesh;
  for (int i = 0; i <= kAlong; ++i) {
    const double t = static_cast<double>(i) / kAlong;
    const Frame frame = blade_frame(leaf, base, t);
    const double half_width = 0.5 * leaf.width_m * outline(t);
    // The ends are points: one vertex there.
    const int across = i == 0 || i == kAlong ? 0 : kAcross;
    for (int k = 0; k <= across; ++k) {
      const double a = across == 0 ? 0.0 : 2.0 * k / kAcross - 1.0;
      const Vec3 p = frame.origin + half_width * (a * std::cos(leaf.fold_rad) * frame.side +
                                                  lift(leaf, t, a) * frame.up);
      mesh.vertices.emplace_back(p.cast<float>());
    }
  }
  const auto first_of = [](int i) {
    return i == 0 ? 0U : 1U + static_cast<std::uint32_t>((i - 1) * (kAcross + 1));
  };
  for (int i = 0; i < kAlong; ++i) {
    for (std::uint32_t k = 0; k < kAcross; ++k) {
      const std::uint32_t a = first_of(i) + (i == 0 ? 0 : k);
      const std::uint32_t b = first_of(i) + (i == 0 ? 0 : k + 1);
      const std::uint32_t c = first_of(i + 1) + (i + 1 == kAlong ? 0 : k);
      const std::uint32_t d = first_of(i + 1) + (i + 1 == kAlong ? 0 : k + 1);
      if (i + 1 < kAlong) mesh.triangles.push_back({a, c, d});
      if (i > 0) mesh.triangles.push_back({a, i + 1 == kAlong ? c : d, b});
    }
  }
  compute_normals(mesh);
  return mesh;
}

TriangleMesh make_petiole(const LeafForm& leaf, const Vec3& node) {
  const Vec3 end = petiole_end(leaf, node);
  const Vec3 p1 =
      node + leaf.petiole_m / 3.0 * direction(leaf.azimuth_rad, leaf.petiole_pitch_rad + 0.25);
  const Vec3 p2 =
      end - leaf.petiole_m / 3.0 * direction(leaf.azimuth_rad, leaf.petiole_pitch_rad - 0.15);
  const double radius = std::clamp(0.012 * leaf.length_m, 0.0006, 0.002);
  std::vector<AxisPoint> axis;
  for (int i = 0; i <= 4; ++i) {
    axis.push_back({bezier(node, p1, p2, end, i / 4.0), radius * (1.2 - 0.1 * i)});
  }
  TriangleMesh mesh = make_tube(axis, 5);
  // The midrib: the petiole goes on in the blade as a rib that shows on both sides.
  std::vector<AxisPoint> rib;
  for (int i = 0; i <= kAlong - 1; ++i) {
    const double t = static_cast<double>(i) / kAlong;
    rib.push_back({blade_frame(leaf, end, t).origin, radius * (0.75 - 0.65 * t)});
  }
  mesh.append(make_tube(rib, 4));
  return mesh;
}

}  // namespace canopeer
