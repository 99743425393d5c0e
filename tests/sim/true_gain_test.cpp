#include "canopeer/sim/true_gain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace canopeer {
namespace {

constexpr double kResolution = 0.01;
const ViewFan kFan{.fov_x_rad = 1.2, .fov_y_rad = 0.9};
constexpr TrueGainOptions kImage{.width_px = 80, .height_px = 60, .max_range_m = 1.0};

/// Three boxes stand for fruits: one before a wall, one behind it, and one that does not count.
Scene three_fruits() {
  Scene scene;
  const auto add = [&](const Box& box, PartClass kind, int fruit) {
    ScenePart part;
    part.mesh = make_box(box);
    part.kind = kind;
    part.fruit = fruit;
    scene.parts.push_back(part);
  };
  const Box boxes[] = {Box(Vec3(0.503, -0.157, 0.013), Vec3(0.563, -0.083, 0.081)),
                       Box(Vec3(0.704, 0.011, 0.003), Vec3(0.764, 0.254, 0.073)),
                       Box(Vec3(0.55, 0.12, 0.02), Vec3(0.60, 0.20, 0.09))};
  for (int i = 0; i < 3; ++i) {
    add(boxes[i], PartClass::fruit, i);
    FruitTruth truth;
    truth.id = i;
    truth.counted = i != 2;
    truth.centre = boxes[i].center();
    scene.fruits.push_back(truth);
  }
  add(Box(Vec3(0.62, 0.0, -0.5), Vec3(0.63, 0.083, 0.5)), PartClass::leaf, -1);
  return scene;
}

/// At the origin, looking along x, z up, a little turned.
Pose camera(double turn_rad) {
  Pose T = Pose::Identity();
  T.rotate(Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()));
  Eigen::Matrix3d R;
  R.col(0) = -Vec3::UnitY();
  R.col(1) = -Vec3::UnitZ();
  R.col(2) = Vec3::UnitX();
  return T * Pose(R);
}

/// Where the ray meets the triangle, in lengths of `d`; infinite: nowhere (Möller & Trumbore 1997).
double meets(const Vec3& from, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vec3 p = d.cross(c - a);
  const double det = (b - a).dot(p);
  if (std::abs(det) < 1e-15) return kNever;
  const double u = (from - a).dot(p) / det;
  const Vec3 q = (from - a).cross(b - a);
  const double v = d.dot(q) / det;
  const double t = (c - a).dot(q) / det;
  return u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0 ? kNever : t;
}

/// The voxels of counted fruits that rays through the pixels' centres meet, triangle by triangle.
std::set<std::tuple<int, int, int>> by_rays(const Scene& scene, const Pose& T) {
  std::set<std::tuple<int, int, int>> voxels;
  for (int v = 0; v < kImage.height_px; ++v) {
    for (int u = 0; u < kImage.width_px; ++u) {
      const Vec3 ray((u + 0.5 - 40.0) / 40.0 * std::tan(kFan.fov_x_rad / 2.0),
                     (v + 0.5 - 30.0) / 30.0 * std::tan(kFan.fov_y_rad / 2.0), 1.0);
      const Vec3 d = T.linear() * ray;
      double nearest = std::numeric_limits<double>::infinity();
      int fruit = -1;
      for (const ScenePart& part : scene.parts) {
        for (const auto& t : part.mesh.triangles) {
          const auto at = [&](int i) {
            return Vec3(part.mesh.vertices[t[static_cast<std::size_t>(i)]].cast<double>());
          };
          const double depth = meets(T.translation(), d, at(0), at(1), at(2));
          if (depth >= nearest) continue;
          nearest = depth;
          fruit = part.fruit;
        }
      }
      if (fruit < 0 || !scene.fruits[static_cast<std::size_t>(fruit)].counted) continue;
      if (nearest > kImage.max_range_m) continue;
      const VoxelIndex voxel = voxel_at(T.translation() + nearest * d, kResolution);
      voxels.emplace(voxel.x(), voxel.y(), voxel.z());
    }
  }
  return voxels;
}

TEST(TrueGain, ShowsTheFruitVoxelsThatRaysMeetFirst) {
  const Scene scene = three_fruits();
  const TrueGain gain(scene, kFan, kImage);
  for (const double turn : {-0.3, 0.0, 0.17, 0.4}) {
    const auto expected = by_rays(scene, camera(turn));
    const VoxelSet found = gain.fruit_voxels(camera(turn), kResolution);
    // No face lies on a border between voxels; pixels on edges may differ.
    int missing = 0;
    for (const auto& [x, y, z] : expected) missing += found.contains({x, y, z}) ? 0 : 1;
    EXPECT_GT(expected.size(), 20U);
    EXPECT_LE(missing, static_cast<int>(expected.size() / 20));
    EXPECT_NEAR(static_cast<double>(found.count()), static_cast<double>(expected.size()),
                static_cast<double>(expected.size()) / 20.0);
  }
}

TEST(TrueGain, LeavesOutWhatTheMapKnowsAndIsValidUntilThatChanges) {
  const Scene scene = three_fruits();
  const TrueGain gain(scene, kFan, kImage);
  VoxelMap map;
  const ViewCast all = gain.cast(map, camera(0.0));
  EXPECT_EQ(all.unknown, gain.fruit_voxels(camera(0.0), map.resolution_m()));
  std::vector<VoxelIndex> voxels;
  all.unknown.for_each([&](const VoxelIndex& v) { voxels.push_back(v); });
  ASSERT_GT(voxels.size(), 10U);
  map.set_occupancy_log_odds(voxels[3], 1.0);   // seen
  map.set_occupancy_log_odds(voxels[7], -1.0);  // seen through
  EXPECT_FALSE(still_valid(all, {block_key(voxels[3])}));
  const ViewCast rest = gain.cast(map, camera(0.0));
  EXPECT_EQ(rest.unknown.count(), all.unknown.count() - 2);
  EXPECT_FALSE(rest.unknown.contains(voxels[3]));
  EXPECT_FALSE(rest.unknown.contains(voxels[7]));
  // Elsewhere anything may change.
  EXPECT_TRUE(still_valid(rest, {block_key(VoxelIndex(-500, 0, 0))}));
}

TEST(TrueGain, OfAViewAwayFromFruitsIsNothingForGood) {
  const TrueGain gain(three_fruits(), kFan, kImage);
  const ViewCast cast = gain.cast(VoxelMap(), camera(3.0));
  EXPECT_TRUE(cast.unknown.empty());
  EXPECT_TRUE(still_valid(cast, {block_key(VoxelIndex(50, -10, 4))}));
}

}  // namespace
}  // namespace canopeer
