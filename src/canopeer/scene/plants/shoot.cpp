#include "canopeer/scene/plants/shoot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canopeer/base/check.h"
#include "canopeer/geometry/angles.h"
#include "canopeer/scene/plants/statistics.h"

namespace canopeer {
namespace {

constexpr double kStep = 0.015;  // between axis points
constexpr double kTipRadius = 0.0005;
constexpr double kForkTipRise = 0.05;
constexpr double kLowestFork = 0.10;

// Radius over base radius along the shoot, as measured on plants 3–6.
constexpr std::array<Quantile, 5> kTaper = {
    {{0.0, 1.0}, {0.25, 0.65}, {0.5, 0.54}, {0.75, 0.38}, {1.0, 0.0}}};

Vec3 horizontal(double azimuth) { return {std::cos(azimuth), std::sin(azimuth), 0.0}; }

/// A line from `base` towards `along` that bows out sideways; a fork's bow lets it leave its stem
/// at a wide angle and then rise beside it.
Shoot make_shoot(const Vec3& base, const Vec3& along, double length, double base_radius,
                 const Vec3& bow, const Vec3& sway) {
  Shoot shoot;
  shoot.length_m = length;
  const int steps = std::max(4, static_cast<int>(std::lround(length / kStep)));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Vec3 p =
        base + t * length * along + std::sin(kPi * t) * bow + std::sin(2.0 * kPi * t) * sway;
    shoot.axis.push_back({p, std::max(kTipRadius, base_radius * value_at_rank(kTaper, t))});
  }
  return shoot;
}

Shoot grow_stem(const PlantKind& kind, int index, double length, double azimuth, Rng& rng) {
  // A string leads a shoot up nearly straight.
  const bool led = kind.string_m > 0.0;
  const double lean = led               ? rng.uniform(0.04, 0.08)
                      : kind.stems == 1 ? rng.uniform(0.03, 0.14)
                                        : rng.uniform(0.08, 0.22);
  const Vec3 along = std::cos(lean) * Vec3::UnitZ() + std::sin(lean) * horizontal(azimuth);
  const double bend = (led ? 0.3 : 1.0) * length * rng.uniform(0.012, 0.045);
  const double offset = led ? 0.05 : index == 0 ? 0.0 : 0.03;
  const Vec3 base = offset * horizontal(azimuth);
  const double sway_azimuth = rng.uniform(0.0, 2.0 * kPi);
  const double bow_azimuth = rng.uniform(0.0, 2.0 * kPi);
  return make_shoot(base, along, length, kind.stem_radius_m * rng.uniform(0.9, 1.1),
                    bend * horizontal(bow_azimuth), 0.4 * bend * horizontal(sway_azimuth));
}

Shoot grow_fork(const Shoot& stem, double length, double azimuth, Rng& rng) {
  // A long fork leaves low: its tip comes no higher than its stem's.
  const double highest = std::max(kLowestFork, stem.length_m - 0.97 * length);
  const double s = std::min(rng.uniform(0.12, 0.30), highest);
  const AxisPoint start = stem.at(std::min(s, 0.5 * stem.length_m));
  const double lean = rng.uniform(0.14, 0.31);
  const Vec3 along = std::cos(lean) * Vec3::UnitZ() + std::sin(lean) * horizontal(azimuth);
  const double bow = length * rng.uniform(0.06, 0.10);
  Shoot fork = make_shoot(start.position, along, length, 0.8 * start.radius_m,
                          bow * horizontal(azimuth + rng.uniform(-0.5, 0.5)), Vec3::Zero());
  fork.fork = true;
  return fork;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

}  // namespace

AxisPoint Shoot::at(double s) const {
  const double index = std::clamp(s / length_m, 0.0, 1.0) * static_cast<double>(axis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(index), axis.size() - 2);
  const double t = index - static_cast<double>(i);
  return {(1.0 - t) * axis[i].position + t * axis[i + 1].position,
          (1.0 - t) * axis[i].radius_m + t * axis[i + 1].radius_m};
}

double Shoot::reach_height(double z) const {
  for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
    const double a = axis[i].position.z();
    const double b = axis[i + 1].position.z();
    if (a <= z && z < b) {
      return (static_cast<double>(i) + (z - a) / (b - a)) * length_m /
             static_cast<double>(axis.size() - 1);
    }
  }
  return -1.0;
}

std::vector<Shoot> grow_shoots(const PlantKind& kind, Rng& rng) {
  CANOPEER_CHECK(kind.stems >= 1 && kind.forks <= kind.stems, "at most one fork a stem");
  // Where nothing forks the stems share the measured length; otherwise stems reach the measured
  // height and the forks have the rest.
  const double stem_length =
      kind.forks == 0 ? kind.shoot_length_m / kind.stems : 1.01 * (kind.height_m - kForkTipRise);
  std::vector<Shoot> shoots;
  std::vector<double> azimuths;
  // Strings lead the shoots of a plant to either side of the row (V system); rows run along y.
  const double first = kind.string_m > 0.0 ? 0.0 : rng.uniform(0.0, 2.0 * kPi);
  for (int i = 0; i < kind.stems; ++i) {
    azimuths.push_back(first + 2.0 * kPi * i / kind.stems + rng.normal(0.0, 0.3));
    const double share = kind.stems == 1 ? 1.0 : rng.uniform(0.96, 1.04);
    shoots.push_back(grow_stem(kind, i, share * stem_length, azimuths.back(), rng));
  }
  for (int i = 0; i < kind.forks; ++i) {
    const double length = (kind.shoot_length_m - kind.stems * stem_length) / kind.forks;
    // Away from its own stem, and with two stems also across the line between them.
    const double turn = kind.stems == 1 ? kPi : 0.5 * kPi;
    const auto stem = static_cast<std::size_t>(i);
    shoots.push_back(
        grow_fork(shoots[stem], length, azimuths[stem] + turn + rng.normal(0.0, 0.3), rng));
  }
  return shoots;
}

double distance_to_shoots(const std::vector<Shoot>& shoots, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Shoot& shoot : shoots) {
    for (std::size_t i = 0; i + 1 < shoot.axis.size(); ++i) {
      nearest = std::min(
          nearest, distance_to_segment(p, shoot.axis[i].position, shoot.axis[i + 1].position));
    }
  }
  return nearest;
}

}  // namespace canopeer
