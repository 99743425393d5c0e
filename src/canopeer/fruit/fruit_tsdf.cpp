#include "canopeer/fruit/fruit_tsdf.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/fruit/voxel_key.h"

namespace canopeer {
namespace {

/// Neighbours across an edge: a step in depth makes a pixel a mix of two surfaces on real sensors.
bool at_depth_edge(const DepthImage& depth, int u, int v, float max_step) {
  if (u < 1 || v < 1 || u + 1 >= depth.width() || v + 1 >= depth.height()) return true;
  const float z = depth.at(u, v);
  const auto step = [&](int du, int dv) {
    const float neighbour = depth.at(u + du, v + dv);
    return neighbour > 0.0F && std::abs(neighbour - z) > max_step;
  };
  return step(-1, 0) || step(1, 0) || step(0, -1) || step(0, 1);
}

/// Blocks whose cells have a voxel for a corner, by whether it is the first along x (1), y (2), z
/// (4): all that only go down along those axes.
constexpr std::uint8_t kBelow[8] = {0b00000001, 0b00000011, 0b00000101, 0b00001111,
                                    0b00010001, 0b00110011, 0b01010101, 0b11111111};

/// Depth errors grow with the square of the distance, so a pixel counts as much as it is sure.
float weight_at(float depth_m) {
  constexpr float kUnitDepth = 0.5F;
  const float ratio = kUnitDepth / depth_m;
  return std::clamp(ratio * ratio, 0.05F, 1.0F);
}

}  // namespace

Expected<void> TsdfOptions::validate() const {
  if (!(voxel_m >= 0.0005) || voxel_m > 0.02) return fail("voxel_m must be in [0.0005, 0.02]");
  if (truncation_m < 2.0 * voxel_m || truncation_m > 8.0 * voxel_m) {
    return fail("truncation_m must be 2 to 8 voxels");
  }
  if (!(max_range_m > 0.0)) return fail("max_range_m must be positive");
  if (!(max_depth_step_m > 0.0)) return fail("max_depth_step_m must be positive");
  if (!(max_weight >= 1.0)) return fail("max_weight must be at least 1");
  if (!(changed_m > 0.0)) return fail("changed_m must be positive");
  return {};
}

FruitTsdf::FruitTsdf(const TsdfOptions& options) : options_(options) {
  CANOPEER_CHECK(options.validate().has_value(), "validate options where they come from");
}

int FruitTsdf::block_at(const VoxelIndex& block) const {
  const auto found = number_of_.find(voxel_key(block));
  return found == number_of_.end() ? -1 : found->second;
}

void FruitTsdf::add(const RgbdFrame& frame, const Image<std::uint8_t>& classes) {
  const CameraIntrinsics& k = frame.intrinsics;
  CANOPEER_CHECK(classes.width() == k.width && classes.height() == k.height, "of this frame");
  CANOPEER_CHECK(frame.depth.width() == k.width && frame.depth.height() == k.height,
                 "depth as the intrinsics say");
  ++frames_;
  allocate(frame, classes);
  const double side_m = kSide * options_.voxel_m;
  const double reach_m = 0.5 * std::sqrt(3.0) * side_m;
  const Pose T_camera_world = frame.T_world_camera.inverse();
  for (const auto& block : blocks_) {
    const Vec3 c = T_camera_world * voxel_centre(block->index, side_m);
    if (c.z() < reach_m + 0.02 || c.z() > options_.max_range_m + reach_m) continue;
    const double u = k.fx * c.x() / c.z() + k.cx;
    const double v = k.fy * c.y() / c.z() + k.cy;
    const double margin = k.fx * reach_m / (c.z() - reach_m);
    if (u < -margin || v < -margin || u > k.width + margin || v > k.height + margin) continue;
    fuse_block(*block, frame, classes);
  }
}

/// Makes the blocks within the truncation of fruit pixels.
void FruitTsdf::allocate(const RgbdFrame& frame, const Image<std::uint8_t>& classes) {
  const CameraIntrinsics& k = frame.intrinsics;
  const double side_m = kSide * options_.voxel_m;
  // Every pixel of far surfaces, every other one of near ones: voxels are larger than pixels.
  const auto step = static_cast<float>(options_.max_depth_step_m);
  seen_.clear();
  VoxelIndex last_low = VoxelIndex::Constant(1 << 20);
  VoxelIndex last_high = last_low;
  for (int v = 1; v + 1 < k.height; ++v) {
    for (int u = 1 + v % 2; u + 1 < k.width; u += 2) {
      if (classes.at(u, v) == 0) continue;
      const float z = frame.depth.at(u, v);
      if (!(z > 0.0F) || z > options_.max_range_m) continue;
      const Vec3 p = frame.T_world_camera * (double{z} * k.ray(u, v));
      const Vec3 around = Vec3::Constant(options_.truncation_m);
      const VoxelIndex low = voxel_at(p - around, side_m);
      const VoxelIndex high = voxel_at(p + around, side_m);
      if (low == last_low && high == last_high) continue;
      if (at_depth_edge(frame.depth, u, v, step)) continue;
      last_low = low;
      last_high = high;
      for (int x = low.x(); x <= high.x(); ++x) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int w = low.z(); w <= high.z(); ++w) {
            const VoxelIndex index(x, y, w);
            const auto [entry, is_new] =
                number_of_.try_emplace(voxel_key(index), static_cast<int>(blocks_.size()));
            if (is_new) {
              blocks_.push_back(std::make_unique<Block>());
              blocks_.back()->index = index;
            }
            Block& block = *blocks_[static_cast<std::size_t>(entry->second)];
            if (block.fruit_frame == frames_) continue;
            block.fruit_frame = frames_;
            seen_.push_back(entry->second);
          }
        }
      }
    }
  }
  std::sort(seen_.begin(), seen_.end());
}

void FruitTsdf::fuse_block(Block& block, const RgbdFrame& frame,
                           const Image<std::uint8_t>& classes) const {
  const CameraIntrinsics& k = frame.intrinsics;
  const auto truncation = static_cast<float>(options_.truncation_m);
  const auto max_weight = static_cast<float>(options_.max_weight);
  const auto max_range = static_cast<float>(options_.max_range_m);
  const auto max_step = static_cast<float>(options_.max_depth_step_m);
  const auto near_surface = static_cast<float>(1.5 * options_.voxel_m);
  const auto changed = static_cast<float>(options_.changed_m);
  const bool colored = !frame.color.empty();
  const Pose T_camera_world = frame.T_world_camera.inverse();
  const Eigen::Matrix3f step = (T_camera_world.linear() * options_.voxel_m).template cast<float>();
  const VoxelIndex first = block.index * kSide;
  const Eigen::Vector3f origin =
      (T_camera_world * voxel_centre(first, options_.voxel_m)).template cast<float>();
  const auto fx = static_cast<float>(k.fx);
  const auto fy = static_cast<float>(k.fy);
  const auto cx = static_cast<float>(k.cx);
  const auto cy = static_cast<float>(k.cy);
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      Eigen::Vector3f p =
          origin + static_cast<float>(y) * step.col(1) + static_cast<float>(z) * step.col(2);
      for (int x = 0; x < kSide; ++x, p += step.col(0)) {
        if (!(p.z() > 0.05F)) continue;
        const float slope_u = p.x() / p.z();
        const float slope_v = p.y() / p.z();
        const float u_real = fx * slope_u + cx;
        const float v_real = fy * slope_v + cy;
        if (!(u_real >= 0.0F && v_real >= 0.0F)) continue;
        const int u = static_cast<int>(u_real);
        const int v = static_cast<int>(v_real);
        if (u >= k.width || v >= k.height) continue;
        const float depth = frame.depth.at(u, v);
        if (!(depth > 0.0F)) continue;
        const float per_depth = std::sqrt(1.0F + slope_u * slope_u + slope_v * slope_v);
        const float distance = (depth - p.z()) * per_depth;
        if (distance < -truncation) continue;
        if (depth > max_range && distance < truncation) continue;
        if (distance < truncation && at_depth_edge(frame.depth, u, v, max_step)) continue;
        TsdfVoxel& voxel = block.voxels[static_cast<std::size_t>(offset(x, y, z))];
        const float weight = weight_at(p.z());
        const float before = voxel.distance_m;
        const float sum = voxel.weight + weight;
        voxel.distance_m = (voxel.weight * before + weight * std::min(distance, truncation)) / sum;
        if (std::abs(voxel.distance_m) < 2.0F * near_surface ||
            std::abs(before) < 2.0F * near_surface) {
          const bool moved = voxel.weight == 0.0F || std::abs(voxel.distance_m - before) > changed;
          if (moved) block.changed |= kBelow[(x == 0) + 2 * (y == 0) + 4 * (z == 0)];
        }
        voxel.weight = std::min(sum, max_weight);
        if (std::abs(distance) > near_surface) continue;
        const std::uint8_t what = classes.at(u, v);
        voxel.votes[std::min<std::size_t>(what, kPixelLabels - 1)] += weight;
        if (what == 0 || !colored) continue;
        const Rgb& c = frame.color.at(u, v);
        voxel.color_weight += weight;
        const float share = weight / voxel.color_weight;
        voxel.color[0] += share * (static_cast<float>(c.r) - voxel.color[0]);
        voxel.color[1] += share * (static_cast<float>(c.g) - voxel.color[1]);
        voxel.color[2] += share * (static_cast<float>(c.b) - voxel.color[2]);
      }
    }
  }
}

std::vector<int> FruitTsdf::take_changed() {
  std::vector<int> numbers;
  for (const auto& block : blocks_) {
    for (int k = 0; k < 8; ++k) {
      if ((block->changed >> k & 1) == 0) continue;
      const int number = block_at(block->index - VoxelIndex(k & 1, (k >> 1) & 1, k >> 2));
      if (number >= 0) numbers.push_back(number);
    }
    block->changed = 0;
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace canopeer
