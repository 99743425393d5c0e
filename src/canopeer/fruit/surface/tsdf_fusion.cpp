#include "canopeer/fruit/surface/tsdf_fusion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "canopeer/base/simd_vectors.h"

namespace canopeer {
namespace {

using Block = FruitTsdf::Block;
using Common = TsdfFusion::Common;
using NearVoxel = TsdfFusion::NearVoxel;
constexpr int kSide = FruitTsdf::kSide;

/// A block is looked at in eight cubes, each of which may be out of sight.
constexpr int kCube = kSide / 2;
/// Two rows of a cube at once, one above the other along y.
using Lanes = EightFloats;
using Bits = EightBits;

/// Blocks whose cells have a voxel for a corner, by whether it is the first along x (1), y (2), z
/// (4): all that only go down along those axes.
constexpr std::uint8_t kBelow[8] = {0b00000001, 0b00000011, 0b00000101, 0b00001111,
                                    0b00010001, 0b00110011, 0b01010101, 0b11111111};

[[gnu::always_inline]] inline Lanes all(float value) { return all_lanes<Lanes>(value); }

/// Depth errors grow with the square of the distance, so a pixel counts as much as it is sure.
[[gnu::always_inline]] inline Lanes weights_at(const Lanes& depth_m) {
  constexpr float kUnitDepth = 0.5F;
  const Lanes ratio = kUnitDepth / depth_m;
  const Lanes square = ratio * ratio;
  const Lanes low = square < 0.05F ? all(0.05F) : square;
  return low > 1.0F ? all(1.0F) : low;
}

[[gnu::always_inline]] inline Lanes root(const Lanes& square) {
  float values[8];
  store_lanes(square, values);
  for (float& value : values) value = std::sqrt(value);
  return load_lanes<Lanes>(values);
}

/// Two rows of voxels as the camera sees them.
struct ProjectedRows {
  Lanes z;                 ///< depth of the voxel
  Lanes slope_u, slope_v;  ///< of its ray
  Bits u, v;               ///< pixel that sees it, counted from the border around the image
};

/// `first`: camera frame, in front of the camera.
[[gnu::always_inline]] inline ProjectedRows projected(const Eigen::Vector3f& first, int y, int z,
                                                      const Common& c) {
  const Lanes along_x = {0.0F, 1.0F, 2.0F, 3.0F, 0.0F, 1.0F, 2.0F, 3.0F};
  const auto low = static_cast<float>(y);
  const auto high = static_cast<float>(y + 1);
  const Lanes along_y = {low, low, low, low, high, high, high, high};
  const auto along_z = static_cast<float>(z);
  const auto coordinate = [&](int axis) __attribute__((always_inline))->Lanes {
    const Lanes row = first[axis] + along_y * c.step(axis, 1) + along_z * c.step(axis, 2);
    return row + along_x * c.step(axis, 0);
  };
  const auto pixel = [](const Lanes& at, float last) __attribute__((always_inline))->Bits {
    const Lanes low_cut = at > 0.0F ? at : all(0.0F);
    return __builtin_convertvector(low_cut < last ? low_cut : all(last), Bits);
  };
  ProjectedRows p;
  p.z = coordinate(2);
  p.slope_u = coordinate(0) / p.z;
  p.slope_v = coordinate(1) / p.z;
  p.u = pixel(c.fx * p.slope_u + c.cx, c.last_u);
  p.v = pixel(c.fy * p.slope_v + c.cy, c.last_v);
  return p;
}

/// The mean of what a row knew and sees now. `away`: from the voxel to the surface its pixel sees.
[[gnu::always_inline]] inline void fuse_rows(Block& block, std::size_t voxel, const Bits& taken,
                                             const Lanes& away, const Lanes& weight,
                                             const Common& c) {
  float* const distances = &block.distance_m[voxel];
  float* const weights = &block.weight[voxel];
  const Lanes before =
      joined(load_lanes<FourFloats>(distances), load_lanes<FourFloats>(distances + kSide));
  const Lanes weight_before =
      joined(load_lanes<FourFloats>(weights), load_lanes<FourFloats>(weights + kSide));
  const Lanes sum = weight_before + weight;
  const Lanes cut = away < c.truncation ? away : all(c.truncation);
  const Lanes now = (weight_before * before + weight * cut) / sum;
  const Lanes distance_after = taken ? now : before;
  store_lanes(low_half(distance_after), distances);
  store_lanes(high_half(distance_after), distances + kSide);
  const Lanes kept = sum < c.max_weight ? sum : all(c.max_weight);
  const Lanes weight_after = taken ? kept : weight_before;
  store_lanes(low_half(weight_after), weights);
  store_lanes(high_half(weight_after), weights + kSide);

  const unsigned here = lane_bits(taken);
  const unsigned seen = lane_bits(taken & (sum >= FruitTsdf::kSeenWeight));
  const unsigned inside = lane_bits(taken & (now < 0.0F));
  const Lanes change = now - before;
  const float band = 2.0F * c.near_surface;
  const Bits near = ((now < band) & (now > -band)) | ((before < band) & (before > -band));
  const Bits moved = (weight_before == 0.0F) | (change > c.changed) | (change < -c.changed);
  const unsigned changed = lane_bits(taken & near & moved);
  const std::size_t x = voxel % kSide;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t row = voxel / kSide + k;
    const auto part = [&](unsigned bits) { return (bits >> (4 * k) & 0xFU) << x; };
    block.seen[row] |= static_cast<std::uint8_t>(part(seen));
    block.inside[row] = static_cast<std::uint8_t>((block.inside[row] & ~part(here)) | part(inside));
    const unsigned row_changed = changed >> (4 * k) & 0xFU;
    if (row_changed == 0) continue;
    const std::size_t side = 2 * (row % kSide == 0) + 4 * (row < kSide);
    if (x == 0 && (row_changed & 1U) != 0) block.changed |= kBelow[1 + side];
    if (x != 0 || (row_changed & ~1U) != 0) block.changed |= kBelow[side];
  }
}

/// `corner`: of the cube's first voxel, camera frame. Fills `near`; returns how many there are.
[[gnu::always_inline]] inline int fuse_cube_body(Block& block, const VoxelIndex& first,
                                                 const Eigen::Vector3f& corner, const Common& c,
                                                 NearVoxel* near) {
  int count = 0;
  for (int pair = 0; pair < kCube * kCube / 2; ++pair) {
    const int y = pair % (kCube / 2) * 2;
    const int z = pair / (kCube / 2);
    const ProjectedRows p = projected(corner, y, z, c);
    const Bits pixel = p.v * c.stride + p.u;
    const Lanes marked = {c.depths[pixel[0]], c.depths[pixel[1]], c.depths[pixel[2]],
                          c.depths[pixel[3]], c.depths[pixel[4]], c.depths[pixel[5]],
                          c.depths[pixel[6]], c.depths[pixel[7]]};
    const Lanes farther = (marked < 0.0F ? -marked : marked) - p.z;
    // Behind what is seen by depth alone, so more so along the ray.
    if (lane_bits(farther >= -c.truncation) == 0) continue;
    // The length of a ray for each metre of depth.
    const Lanes per_depth = root(1.0F + p.slope_u * p.slope_u + p.slope_v * p.slope_v);
    const Lanes away = farther * per_depth;
    // A marked pixel tells of free space only, one without depth of nothing.
    const Bits taken =
        (marked != 0.0F) & (away >= (marked < 0.0F ? all(c.truncation) : all(-c.truncation)));
    if (lane_bits(taken) == 0) continue;
    const std::size_t voxel = FruitTsdf::offset(first.x(), first.y() + y, first.z() + z);
    const Lanes weight = weights_at(p.z);
    fuse_rows(block, voxel, taken, away, weight, c);
    const Lanes size = away < 0.0F ? -away : away;
    for (unsigned bits = lane_bits(taken & (size <= c.near_surface)); bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      const std::size_t at = voxel + static_cast<std::size_t>(i % 4 + i / 4 * kSide);
      near[count++] = {at, weight[i], p.u[i], p.v[i]};
    }
  }
  return count;
}

CANOPEER_WIDE int fuse_cube_wide(Block& block, const VoxelIndex& first,
                                 const Eigen::Vector3f& corner, const Common& c, NearVoxel* near) {
  return fuse_cube_body(block, first, corner, c, near);
}

int fuse_cube_narrow(Block& block, const VoxelIndex& first, const Eigen::Vector3f& corner,
                     const Common& c, NearVoxel* near) {
  return fuse_cube_body(block, first, corner, c, near);
}

}  // namespace

TsdfFusion::TsdfFusion(const RgbdFrame& frame, const Image<std::uint8_t>& classes,
                       const FrameDepths& depths, const TsdfOptions& options, SimdLevel level)
    : frame_(frame),
      classes_(classes),
      depths_(depths),
      options_(options),
      T_camera_world_(frame.T_world_camera.inverse()),
      level_(level) {
  const CameraIntrinsics& k = frame.intrinsics;
  Common& c = common_;
  c.step = (T_camera_world_.linear() * options.voxel_m).cast<float>();
  c.depths = depths.marked();
  c.fx = static_cast<float>(k.fx);
  c.fy = static_cast<float>(k.fy);
  c.cx = static_cast<float>(k.cx) + 1.0F;
  c.cy = static_cast<float>(k.cy) + 1.0F;
  c.last_u = static_cast<float>(k.width + 1);
  c.last_v = static_cast<float>(k.height + 1);
  c.stride = k.width + 2;
  c.truncation = static_cast<float>(options.truncation_m);
  c.max_weight = static_cast<float>(options.max_weight);
  c.near_surface = static_cast<float>(1.5 * options.voxel_m);
  c.changed = static_cast<float>(options.changed_m);
}

void TsdfFusion::fuse(Block& block) const {
  const double reach_m = 0.5 * std::sqrt(3.0) * kSide * options_.voxel_m;
  const Vec3 centre = T_camera_world_ * voxel_centre(block.index, kSide * options_.voxel_m);
  if (!in_sight(centre, reach_m)) return;
  const Eigen::Matrix3d to_cube = T_camera_world_.linear() * (0.5 * kCube * options_.voxel_m);
  for (int cube = 0; cube < 8; ++cube) {
    const VoxelIndex upper(cube & 1, (cube >> 1) & 1, cube >> 2);
    const Vec3 offset = 2.0 * upper.cast<double>() - Vec3::Ones();
    if (in_sight(centre + to_cube * offset, 0.5 * reach_m)) fuse_cube(block, kCube * upper);
  }
}

/// Whether the frame may tell anything of what lies within `reach_m` of a place: it is in front of
/// the camera, and some pixel on it sees as far.
bool TsdfFusion::in_sight(const Vec3& c, double reach_m) const {
  const CameraIntrinsics& k = frame_.intrinsics;
  if (c.z() < reach_m + 0.02 || c.z() > options_.max_range_m + reach_m) return false;
  const double u = k.fx * c.x() / c.z() + k.cx;
  const double v = k.fy * c.y() / c.z() + k.cy;
  const double margin = k.fx * reach_m / (c.z() - reach_m) * (1.0 + std::abs(c.x() / c.z())) + 1.0;
  const double margin_v =
      k.fy * reach_m / (c.z() - reach_m) * (1.0 + std::abs(c.y() / c.z())) + 1.0;
  if (u < -margin || v < -margin_v || u > k.width + margin || v > k.height + margin_v) return false;
  const double farthest = depths_.farthest(u - margin, v - margin_v, u + margin, v + margin_v);
  return farthest > 0.0 && farthest - (c.z() - reach_m) > -1.001 * options_.truncation_m;
}

void TsdfFusion::fuse_cube(Block& block, const VoxelIndex& first) const {
  std::array<NearVoxel, kCube * kCube * kCube> near;
  const Eigen::Vector3f corner =
      (T_camera_world_ * voxel_centre(block.index * kSide + first, options_.voxel_m)).cast<float>();
  const auto fuse = level_ >= SimdLevel::avx2 ? fuse_cube_wide : fuse_cube_narrow;
  const int count = fuse(block, first, corner, common_, near.data());
  for (int i = 0; i < count; ++i) take_looks(block.looks[near[i].voxel], near[i]);
}

void TsdfFusion::take_looks(TsdfLooks& looks, const NearVoxel& near) const {
  const std::uint8_t what = classes_.at(near.u - 1, near.v - 1);
  looks.votes[std::min<std::size_t>(what, kPixelLabels - 1)] += near.weight;
  if (what == 0 || frame_.color.empty()) return;
  const Rgb& c = frame_.color.at(near.u - 1, near.v - 1);
  looks.color_weight += near.weight;
  const float share = near.weight / looks.color_weight;
  looks.color[0] += share * (static_cast<float>(c.r) - looks.color[0]);
  looks.color[1] += share * (static_cast<float>(c.g) - looks.color[1]);
  looks.color[2] += share * (static_cast<float>(c.b) - looks.color[2]);
}

}  // namespace canopeer
