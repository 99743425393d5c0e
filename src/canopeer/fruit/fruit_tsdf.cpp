#include "canopeer/fruit/fruit_tsdf.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "canopeer/base/check.h"
#include "canopeer/fruit/depth_tiles.h"
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

/// Most of an image is no fruit: eight pixels are told at once.
bool none_of_eight(const std::uint8_t* labels) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, labels, sizeof eight);
  return eight == 0;
}

/// Depth errors grow with the square of the distance, so a pixel counts as much as it is sure.
Four weights_at(const Four& depth_m) {
  constexpr float kUnitDepth = 0.5F;
  const Four ratio = kUnitDepth / depth_m;
  const Four square = ratio * ratio;
  const Four low = square < 0.05F ? all(0.05F) : square;
  return low > 1.0F ? all(1.0F) : low;
}

Four four(const Eigen::Array4f& a) { return load_four(a.data()); }

}  // namespace

/// Depths as voxels ask for them: negative where the pixel is at an edge or too far away to show a
/// surface, so that it only tells what is free before it; with a border of one pixel without any,
/// so that voxels just outside of the image need no question of their own.
std::vector<float> marked_depths(const DepthImage& depth, float max_range, float max_step) {
  const int width = depth.width();
  const int height = depth.height();
  const std::ptrdiff_t stride = width + 2;
  std::vector<float> marked(static_cast<std::size_t>(stride * (height + 2)), 0.0F);
  const float* const all = depth.pixels().data();
  for (int v = 0; v < height; ++v) {
    const float* const row = all + std::ptrdiff_t{v} * width;
    const float* const up = v > 0 ? row - width : row;
    const float* const down = v + 1 < height ? row + width : row;
    float* const out = marked.data() + (v + 1) * stride + 1;
    const bool border = v == 0 || v + 1 == height;
    const auto is_step = [&](const Four& near, const Four& z) -> FourBits {
      const Four rise = near - z;
      return (near > 0.0F) & ((rise > max_step) | (rise < -max_step));
    };
    int u = 1;
    for (; u + 5 <= width; u += 4) {
      const Four z = load_four(row + u);
      const FourBits edge = (z > max_range) | is_step(load_four(row + u - 1), z) |
                            is_step(load_four(row + u + 1), z) | is_step(load_four(up + u), z) |
                            is_step(load_four(down + u), z);
      store_four(edge ? -z : z, out + u);
    }
    for (; u + 1 < width; ++u) {
      const float z = row[u];
      const auto step = [&](float near) { return near > 0.0F && std::abs(near - z) > max_step; };
      const bool edge =
          z > max_range || step(row[u - 1]) || step(row[u + 1]) || step(up[u]) || step(down[u]);
      out[u] = edge ? -z : z;
    }
    if (border) {
      for (u = 0; u < width; ++u) out[u] = -row[u];
    }
    out[0] = -row[0];
    out[width - 1] = -row[width - 1];
  }
  return marked;
}

/// A frame with what all blocks want to know of it.
struct FruitTsdf::View {
  View(const RgbdFrame& f, const Image<std::uint8_t>& c, const TsdfOptions& o)
      : frame(f),
        classes(c),
        T_camera_world(f.T_world_camera.inverse()),
        step((T_camera_world.linear() * o.voxel_m).cast<float>()),
        tiles(f.depth),
        depths(marked_depths(f.depth, static_cast<float>(o.max_range_m),
                             static_cast<float>(o.max_depth_step_m))),
        truncation(static_cast<float>(o.truncation_m)),
        max_weight(static_cast<float>(o.max_weight)),
        near_surface(static_cast<float>(1.5 * o.voxel_m)),
        changed(static_cast<float>(o.changed_m)) {}

  const RgbdFrame& frame;
  const Image<std::uint8_t>& classes;
  Pose T_camera_world;
  Eigen::Matrix3f step;  // from voxel to voxel along x, y, z, camera frame
  DepthTiles tiles;
  std::vector<float> depths;
  float truncation, max_weight, near_surface, changed;
};

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
  const Block& held = *blocks_[static_cast<std::size_t>(number)];
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
  const View view(frame, classes, options_);
  for (const auto& block : blocks_) fuse_block(*block, view);
}

/// Whether the frame may tell anything of what lies within `reach_m` of a place: it is in front of
/// the camera, and some pixel on it sees as far.
bool FruitTsdf::in_sight(const Vec3& c, double reach_m, const View& view) const {
  const CameraIntrinsics& k = view.frame.intrinsics;
  if (c.z() < reach_m + 0.02 || c.z() > options_.max_range_m + reach_m) return false;
  const double u = k.fx * c.x() / c.z() + k.cx;
  const double v = k.fy * c.y() / c.z() + k.cy;
  const double margin = k.fx * reach_m / (c.z() - reach_m) * (1.0 + std::abs(c.x() / c.z())) + 1.0;
  const double margin_v =
      k.fy * reach_m / (c.z() - reach_m) * (1.0 + std::abs(c.y() / c.z())) + 1.0;
  if (u < -margin || v < -margin_v || u > k.width + margin || v > k.height + margin_v) return false;
  const double farthest = view.tiles.farthest(u - margin, v - margin_v, u + margin, v + margin_v);
  return farthest > 0.0 && farthest - (c.z() - reach_m) > -1.001 * options_.truncation_m;
}

/// An empty block, made known to those around it.
int FruitTsdf::make_block(const VoxelIndex& index) {
  const int number = static_cast<int>(blocks_.size());
  number_of_.emplace(voxel_key(index), number);
  Block& block = *blocks_.emplace_back(std::make_unique<Block>());
  block.index = index;
  for (std::size_t k = 0; k < block.around.size(); ++k) {
    const int i = static_cast<int>(k);
    const int other = block_at(index + VoxelIndex(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    block.around[k] = other;
    if (other >= 0) blocks_[static_cast<std::size_t>(other)]->around[26 - k] = number;
  }
  return number;
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
            Block& block = *blocks_[static_cast<std::size_t>(number)];
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

/// A block is looked at in eight cubes, each of which may be out of sight.
constexpr int kCube = FruitTsdf::kSide / 2;

/// Four voxels along x as the camera sees them, all at once.
struct ProjectedRow {
  Eigen::Array4f z;          ///< depth of the voxel
  Eigen::Array4f per_depth;  ///< length of its ray for each metre of depth
  Eigen::Array4i u, v;       ///< pixel that sees it, counted from the border around the image

  /// `first`, `step`: of the first voxel and to the next, in front of the camera.
  ProjectedRow(const Eigen::Vector3f& first, const Eigen::Vector3f& step,
               const CameraIntrinsics& k) {
    const Eigen::Array4f along(0.0F, 1.0F, 2.0F, 3.0F);
    z = first.z() + along * step.z();
    const Eigen::Array4f slope_u = (first.x() + along * step.x()) / z;
    const Eigen::Array4f slope_v = (first.y() + along * step.y()) / z;
    per_depth = (1.0F + slope_u * slope_u + slope_v * slope_v).sqrt();
    const Eigen::Array4f u_real =
        static_cast<float>(k.fx) * slope_u + (static_cast<float>(k.cx) + 1.0F);
    const Eigen::Array4f v_real =
        static_cast<float>(k.fy) * slope_v + (static_cast<float>(k.cy) + 1.0F);
    u = u_real.max(0.0F).min(static_cast<float>(k.width + 1)).cast<int>();
    v = v_real.max(0.0F).min(static_cast<float>(k.height + 1)).cast<int>();
  }
};

void FruitTsdf::fuse_block(Block& block, const View& view) const {
  const double reach_m = 0.5 * std::sqrt(3.0) * kSide * options_.voxel_m;
  const Vec3 centre = view.T_camera_world * voxel_centre(block.index, kSide * options_.voxel_m);
  if (!in_sight(centre, reach_m, view)) return;
  const Eigen::Matrix3d to_cube = view.T_camera_world.linear() * (0.5 * kCube * options_.voxel_m);
  for (int cube = 0; cube < 8; ++cube) {
    const VoxelIndex upper(cube & 1, (cube >> 1) & 1, cube >> 2);
    const Vec3 offset = 2.0 * upper.cast<double>() - Vec3::Ones();
    if (in_sight(centre + to_cube * offset, 0.5 * reach_m, view)) {
      fuse_cube(block, kCube * upper, view);
    }
  }
}

void FruitTsdf::fuse_cube(Block& block, const VoxelIndex& first, const View& view) const {
  const CameraIntrinsics& k = view.frame.intrinsics;
  const float* const depths = view.depths.data();
  const Eigen::Vector3f origin =
      (view.T_camera_world * voxel_centre(block.index * kSide + first, options_.voxel_m))
          .cast<float>();
  for (int row = 0; row < kCube * kCube; ++row) {
    const int y = row % kCube;
    const int z = row / kCube;
    const ProjectedRow p(origin + static_cast<float>(y) * view.step.col(1) +
                             static_cast<float>(z) * view.step.col(2),
                         view.step.col(0), k);
    const Eigen::Array4i pixel = p.v * (k.width + 2) + p.u;
    const Eigen::Array4f marked(depths[pixel[0]], depths[pixel[1]], depths[pixel[2]],
                                depths[pixel[3]]);
    const Eigen::Array4f distance = (marked.abs() - p.z) * p.per_depth;
    if (distance.maxCoeff() < -view.truncation) continue;
    const Four marks = four(marked);
    const Four away = four(distance);
    // A marked pixel tells of free space only, one without depth of nothing.
    const FourBits taken =
        (marks != 0.0F) & (away >= (marks < 0.0F ? all(view.truncation) : all(-view.truncation)));
    if (bits(taken) == 0) continue;
    const std::size_t voxel = offset(first.x(), first.y() + y, first.z() + z);
    const Four weight = weights_at(four(p.z));
    fuse_row(block, voxel, taken, away, weight, view);
    const Four size = away < 0.0F ? -away : away;
    for (unsigned near = bits(taken & (size <= view.near_surface)); near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      take_looks(block.looks[voxel + static_cast<std::size_t>(i)], weight[i],
                 static_cast<std::size_t>((p.v[i] - 1) * k.width + p.u[i] - 1), view);
    }
  }
}

/// Four voxels along x at once. `away`: from the voxel to the surface that its pixel sees.
void FruitTsdf::fuse_row(Block& block, std::size_t voxel, const FourBits& taken, const Four& away,
                         const Four& weight, const View& view) {
  const Four before = load_four(&block.distance_m[voxel]);
  const Four weight_before = load_four(&block.weight[voxel]);
  const Four sum = weight_before + weight;
  const Four cut = away < view.truncation ? away : all(view.truncation);
  const Four now = (weight_before * before + weight * cut) / sum;
  store_four(taken ? now : before, &block.distance_m[voxel]);
  const Four kept = sum < view.max_weight ? sum : all(view.max_weight);
  store_four(taken ? kept : weight_before, &block.weight[voxel]);
  const std::size_t row = voxel / kSide;
  const std::size_t x = voxel % kSide;
  const unsigned here = bits(taken) << x;
  block.seen[row] |= static_cast<std::uint8_t>(bits(taken & (sum >= kSeenWeight)) << x);
  block.inside[row] =
      static_cast<std::uint8_t>((block.inside[row] & ~here) | bits(taken & (now < 0.0F)) << x);
  const Four change = now - before;
  const float band = 2.0F * view.near_surface;
  const FourBits near = ((now < band) & (now > -band)) | ((before < band) & (before > -band));
  const FourBits moved =
      (weight_before == 0.0F) | (change > view.changed) | (change < -view.changed);
  const unsigned changed = bits(taken & near & moved);
  if (changed == 0) return;
  const std::size_t side = 2 * (row % kSide == 0) + 4 * (row < kSide);
  if (x == 0 && (changed & 1U) != 0) block.changed |= kBelow[1 + side];
  if (x != 0 || (changed & ~1U) != 0) block.changed |= kBelow[side];
}

void FruitTsdf::take_looks(TsdfLooks& looks, float weight, std::size_t pixel, const View& view) {
  const std::uint8_t what = view.classes.pixels()[pixel];
  looks.votes[std::min<std::size_t>(what, kPixelLabels - 1)] += weight;
  if (what == 0 || view.frame.color.empty()) return;
  const Rgb& c = view.frame.color.pixels()[pixel];
  looks.color_weight += weight;
  const float share = weight / looks.color_weight;
  looks.color[0] += share * (static_cast<float>(c.r) - looks.color[0]);
  looks.color[1] += share * (static_cast<float>(c.g) - looks.color[1]);
  looks.color[2] += share * (static_cast<float>(c.b) - looks.color[2]);
}

std::vector<int> FruitTsdf::take_changed() {
  std::vector<int> numbers;
  for (const auto& block : blocks_) {
    for (int k = 0; k < 8; ++k) {
      if ((block->changed >> k & 1) == 0) continue;
      const int number = block->around[13 - (k & 1) - 3 * ((k >> 1) & 1) - 9 * (k >> 2)];
      if (number >= 0) numbers.push_back(number);
    }
    block->changed = 0;
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace canopeer
