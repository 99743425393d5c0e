#include "canopeer/scene/plants/fruit_cluster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/geometry/angles.h"
#include "canopeer/scene/plants/canopy_cover.h"
#include "canopeer/scene/plants/statistics.h"

namespace canopeer {
namespace {

constexpr double kNearestCentres = 0.069;   // nearest neighbours' centres
constexpr double kPedicelAboveTop = 0.012;  // where it leaves the shoot
constexpr double kPedicelRadius = 0.0027;
constexpr double kBareTip = 0.10;    // no fruit hangs from the youngest part of a shoot
constexpr double kLeastTail = 0.02;  // between a fruit's lower end and the ground

constexpr std::array<Quantile, 5> kCentreHeight = {
    {{0.0, 0.22}, {0.05, 0.26}, {0.5, 0.38}, {0.95, 0.68}, {1.0, 0.74}}};
constexpr std::array<Quantile, 5> kShootDistance = {
    {{0.0, 0.025}, {0.05, 0.028}, {0.5, 0.056}, {0.95, 0.071}, {1.0, 0.074}}};
// Low places are taken more often by other shoots and fruits: they are tried more often, so that
// the fruits that find room have the measured heights.
constexpr double kLowRanks = 1.15;

/// Two upright blocky bodies, taken as superellipsoids with exponent 3 around both their sizes.
bool bodies_apart(const HangingFruit& a, const HangingFruit& b) {
  const Vec3 d = a.T_plant_fruit.translation() - b.T_plant_fruit.translation();
  const double across = 0.55 * (a.form.diameter_m + b.form.diameter_m);
  const double along = 0.53 * (a.form.length_m + b.form.length_m);
  const double r = d.head<2>().norm() / across;
  const double z = std::abs(d.z()) / along;
  return d.norm() >= kNearestCentres && r * r * r + z * z * z >= 1.0;
}

double draw_height(const PlantKind& kind, Rng& rng) {
  const double rank = rng.uniform();
  if (kind.fruit_high_m > 0.0) {
    return kind.fruit_low_m + rank * (kind.fruit_high_m - kind.fruit_low_m);
  }
  return value_at_rank(kCentreHeight, std::pow(rank, kLowRanks));
}

/// One attempt to hang a fruit somewhere on the plant.
std::optional<HangingFruit> try_hang(const PlantKind& kind, const std::vector<Shoot>& shoots,
                                     Ripeness ripeness, Rng& rng) {
  HangingFruit fruit;
  fruit.ripeness = ripeness;
  fruit.form = draw_fruit(ripeness, rng);
  const double z = draw_height(kind, rng);
  if (z - 0.5 * fruit.form.length_m < kLeastTail) return std::nullopt;
  const Shoot& shoot = shoots[rng.index(shoots.size())];
  const double s_pedicel = shoot.reach_height(z + 0.5 * fruit.form.length_m + kPedicelAboveTop);
  const double s_centre = shoot.reach_height(z);
  if (s_pedicel < 0.0 || s_centre < 0.0 || s_pedicel > shoot.length_m - kBareTip) {
    return std::nullopt;
  }
  // A fat fruit cannot hang nearer to the shoot than its own radius.
  const double clear = 0.5 * fruit.form.diameter_m + shoot.at(s_centre).radius_m;
  const double distance = std::max(value_at_rank(kShootDistance, rng.uniform()), clear);
  const double around = rng.chance(kind.minus_x_share) ? kPi : 0.0;
  const double azimuth = around + rng.uniform(-0.5 * kPi, 0.5 * kPi);
  const Vec3 centre =
      shoot.at(s_centre).position + distance * Vec3(std::cos(azimuth), std::sin(azimuth), 0.0);
  if (distance_to_shoots(shoots, centre) < 0.97 * clear) return std::nullopt;

  const double tilt = kDegree * clipped_normal(rng, 8.0, 5.0, 2.0, 18.0);
  const double tilt_azimuth = rng.uniform(0.0, 2.0 * kPi);
  fruit.T_plant_fruit =
      Eigen::Translation3d(centre) *
      Eigen::AngleAxisd(tilt, Vec3(std::cos(tilt_azimuth), std::sin(tilt_azimuth), 0.0)) *
      Eigen::AngleAxisd(rng.uniform(0.0, 2.0 * kPi), Vec3::UnitZ());
  fruit.pedicel_start = shoot.at(s_pedicel).position;
  return fruit;
}

/// Finds room for one more fruit beside those already there.
std::optional<HangingFruit> find_room(const PlantKind& kind, const std::vector<Shoot>& shoots,
                                      Ripeness ripeness, const std::vector<HangingFruit>& fruits,
                                      Rng& rng) {
  for (int attempt = 0; attempt < 400; ++attempt) {
    const auto fruit = try_hang(kind, shoots, ripeness, rng);
    if (fruit && std::all_of(fruits.begin(), fruits.end(),
                             [&](const HangingFruit& f) { return bodies_apart(f, *fruit); })) {
      return fruit;
    }
  }
  return std::nullopt;
}

/// Hangs one more fruit; false when there is no room left. A sheltered one takes the place that
/// leaves hide best.
bool hang_one(const PlantKind& kind, const std::vector<Shoot>& shoots, const CanopyCover& cover,
              Ripeness ripeness, Rng& rng, std::vector<HangingFruit>* fruits) {
  constexpr int kPlaces = 24;
  const int places = rng.chance(kind.sheltered) ? kPlaces : 1;
  std::optional<HangingFruit> best;
  double least = 0.0;
  for (int i = 0; i < places; ++i) {
    const auto fruit = find_room(kind, shoots, ripeness, *fruits, rng);
    if (!fruit) continue;
    const double shown = places == 1 ? 0.0
                                     : cover.shown_level(fruit->T_plant_fruit.translation(),
                                                         0.5 * fruit->form.diameter_m);
    if (best && shown >= least) continue;
    best = fruit;
    least = shown;
  }
  if (best) fruits->push_back(*best);
  return best.has_value();
}

}  // namespace

std::vector<HangingFruit> hang_fruits(const PlantKind& kind, const std::vector<Shoot>& shoots,
                                      const CanopyCover& cover, Rng& rng) {
  const int total = kind.counted_fruits + kind.green_fruits;
  for (int attempt = 0; attempt < 50; ++attempt) {
    std::vector<HangingFruit> fruits;
    bool room = true;
    for (int i = 0; i < total && room; ++i) {
      const Ripeness ripeness = i >= kind.counted_fruits ? Ripeness::green
                                : rng.chance(0.7)        ? Ripeness::ripe
                                                         : Ripeness::turning;
      room = hang_one(kind, shoots, cover, ripeness, rng, &fruits);
    }
    if (room) return fruits;
  }
  CANOPEER_CHECK(false, "a plant's fruits must fit on its shoots");
}

TriangleMesh make_pedicel(const HangingFruit& fruit) {
  const Vec3 top = fruit.T_plant_fruit * Vec3(0.0, 0.0, fruit_top_m(fruit.form) + 0.003);
  const Vec3 start = fruit.pedicel_start;
  const Vec3 out = Vec3(top.x() - start.x(), top.y() - start.y(), 0.0);
  const Vec3 p1 = start + 0.5 * out + Vec3(0.0, 0.0, 0.008);
  const Vec3 p2 = top + 0.02 * fruit.T_plant_fruit.linear().col(2);
  std::vector<AxisPoint> axis;
  for (int i = 0; i <= 6; ++i)
    axis.push_back({bezier(start, p1, p2, top, i / 6.0), kPedicelRadius});
  return make_tube(axis, 6);
}

bool touches_fruit(const HangingFruit& fruit, const Vec3& p_plant, double margin_m) {
  const Vec3 p = fruit.T_plant_fruit.inverse(Eigen::Isometry) * p_plant;
  const double r = p.head<2>().norm() / (0.5 * fruit.form.diameter_m + margin_m);
  const double z = std::abs(p.z()) / (0.5 * fruit.form.length_m + margin_m);
  return r * r * r + z * z * z < 1.0;
}

}  // namespace canopeer
