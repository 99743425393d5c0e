#include "canopeer/fruit/surface/fruit_tsdf.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "canopeer/base/check.h"
#include "canopeer/fruit/surface/tsdf_fusion.h"
#include "canopeer/fruit/surface/voxel_key.h"

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

/// Most of an image is no fruit: eight pixels are told at once.
bool none_of_eight(const std::uint8_t* labels) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, labels, sizeof eight);
  return eight == 0;
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

std::optional<float> FruitTsdf::distance_at(const VoxelIndex& voxel) const {
  const VoxelIndex block(voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3);
  const int number = block_at(block);
  if (number < 0) return std::nullopt;
  const Block& held = blocks_[static_cast<std::size_t>(number)];
  const std::size_t at = offset(voxel.x() & 7, voxel.y() & 7, voxel.z() & 7);
  if (held.weight[at] < kSeenWeight) return std::nullopt;
  return held.distance_m[at];
}

void FruitTsdf::add(const RgbdFrame& frame, const Image<std::uint8_t>& classes) {
  const CameraIntrinsics& k = frame.intrinsics;
  CANOPEER_CHECK(classes.width() == k.width && classes.height() == k.height, "of this frame");
  CANOPEER_CHECK(frame.depth.width() == k.width && frame.depth.height() == k.height,
                 "depth as the intrinsics say");
  ++frames_;
  allocate(frame, classes);
  depths_.set(frame.depth, static_cast<float>(options_.max_range_m),
              static_cast<float>(options_.max_depth_step_m));
  const TsdfFusion fusion(frame, classes, depths_, options_);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    constexpr std::size_t kAhead = 8;  // blocks lie apart: the next ones are fetched meanwhile
    if (i + kAhead < blocks_.size()) __builtin_prefetch(&blocks_[i + kAhead]);
    fusion.fuse(blocks_[i]);
  }
}

/// An empty block, made known to those around it.
int FruitTsdf::make_block(const VoxelIndex& index) {
  const int number = static_cast<int>(blocks_.size());
  blocks_.emplace_back().index = index;
  link(number);
  return number;
}

void FruitTsdf::link(int number) {
  Block& block = blocks_[static_cast<std::size_t>(number)];
  number_of_.emplace(voxel_key(block.index), number);
  for (std::size_t k = 0; k < block.around.size(); ++k) {
    const int i = static_cast<int>(k);
    const int other = block_at(block.index + VoxelIndex(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    block.around[k] = other;
    if (other >= 0) blocks_[static_cast<std::size_t>(other)].around[26 - k] = number;
  }
}

/// Makes the blocks within the truncation of fruit pixels.
void FruitTsdf::allocate(const RgbdFrame& frame, const Image<std::uint8_t>& classes) {
  const CameraIntrinsics& k = frame.intrinsics;
  const double blocks_per_m = 1.0 / (kSide * options_.voxel_m);
  // Every pixel of far surfaces, every other one of near ones: voxels are larger than pixels.
  const auto step = static_cast<float>(options_.max_depth_step_m);
  const auto max_range = static_cast<float>(options_.max_range_m);
  // In blocks: where the camera is, and what a pixel's ray adds for each metre of depth.
  const Vec3 camera = blocks_per_m * frame.T_world_camera.translation();
  const Eigen::Matrix3d turn = blocks_per_m * frame.T_world_camera.linear();
  const Vec3 along_u = turn.col(0) / k.fx;
  const Vec3 around = Vec3::Constant(blocks_per_m * options_.truncation_m);
  seen_.clear();
  VoxelIndex last_low = VoxelIndex::Constant(1 << 20);
  VoxelIndex last_high = last_low;
  for (int v = 1; v + 1 < k.height; ++v) {
    const Vec3 row = turn * k.ray(0, v);
    const std::uint8_t* const labels = &classes.at(0, v);
    for (int u = 1 + v % 2; u + 1 < k.width; u += 2) {
      if (u + 8 < k.width && none_of_eight(labels + u)) {
        u += 6;
        continue;
      }
      if (labels[u] == 0) continue;
      const float z = frame.depth.at(u, v);
      if (!(z > 0.0F) || z > max_range) continue;
      const Vec3 p = camera + double{z} * (row + u * along_u);
      const VoxelIndex low = (p - around).array().floor().cast<int>();
      const VoxelIndex high = (p + around).array().floor().cast<int>();
      if (low == last_low && high == last_high) continue;
      if (at_depth_edge(frame.depth, u, v, step)) continue;
      last_low = low;
      last_high = high;
      for (int x = low.x(); x <= high.x(); ++x) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int w = low.z(); w <= high.z(); ++w) {
            const VoxelIndex index(x, y, w);
            int number = block_at(index);
            if (number < 0) number = make_block(index);
            Block& block = blocks_[static_cast<std::size_t>(number)];
            if (block.fruit_frame == frames_) continue;
            block.fruit_frame = frames_;
            seen_.push_back(number);
          }
        }
      }
    }
  }
  std::sort(seen_.begin(), seen_.end());
}

bool FruitTsdf::relink() {
  constexpr int kFarthest = (1 << 20) / kSide - 1;  // of a block whose voxels have keys
  number_of_.clear();
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const VoxelIndex& index = blocks_[i].index;
    if (index.maxCoeff() >= kFarthest || index.minCoeff() <= -kFarthest) return false;
    if (block_at(index) >= 0) return false;
    link(static_cast<int>(i));
  }
  return true;
}

std::array<std::uint8_t, FruitTsdf::kSide * FruitTsdf::kSide> FruitTsdf::Block::rows_with_looks()
    const {
  std::array<std::uint8_t, kSide * kSide> rows{};
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const bool any = looks[i] != TsdfLooks{};
    rows[i / kSide] |= static_cast<std::uint8_t>(int{any} << i % kSide);
  }
  return rows;
}

std::vector<int> FruitTsdf::take_changed() {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    constexpr std::size_t kAhead = 8;  // blocks lie apart: the next ones are fetched meanwhile
    if (i + kAhead < blocks_.size()) __builtin_prefetch(&blocks_[i + kAhead].changed);
    Block& block = blocks_[i];
    if (block.changed == 0) continue;
    for (int k = 0; k < 8; ++k) {
      if ((block.changed >> k & 1) == 0) continue;
      const int number = block.around[13 - (k & 1) - 3 * ((k >> 1) & 1) - 9 * (k >> 2)];
      if (number >= 0) numbers.push_back(number);
    }
    block.changed = 0;
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace canopeer
