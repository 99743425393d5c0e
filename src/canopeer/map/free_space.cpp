#include "canopeer/map/free_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "canopeer/map/depth_pyramid.h"

namespace canopeer {
namespace {

// Sides, in voxels, of the cubes the descent starts from and of those whose voxels are tested one
// by one. (The latter are half blocks: near leaves much of a block lies clear of the surface.)
constexpr int kRootSide = 8 * kBlockSide;
constexpr int kLeafSide = kBlockSide / 2;

// A pinhole camera in single precision, pixels in one row-major array.
struct FlatCamera {
  const float* depths;
  float width, height, fx, fy, cx, cy;
};

// Which of four voxels in a row are seen nearer than the depth at their pixel; the first centre is
// `p` and the next ones `step` apart (camera frame). `inside`: all project into the image.
__attribute__((target_clones("avx2", "default"))) unsigned free_in_row(const FlatCamera& camera,
                                                                       const float* p,
                                                                       const float* step,
                                                                       bool inside) {
  std::array<float, kLeafSide> z;
  std::array<int, kLeafSide> pixel;
  std::array<int, kLeafSide> seen;
  for (std::size_t i = 0; i < kLeafSide; ++i) {
    const auto t = static_cast<float>(i);
    z[i] = p[2] + t * step[2];
    const float inverse = 1.0F / z[i];
    const float u = camera.fx * (p[0] + t * step[0]) * inverse + camera.cx;
    const float v = camera.fy * (p[1] + t * step[1]) * inverse + camera.cy;
    const bool valid =
        inside || (z[i] > 0.0F && u >= 0.0F && u < camera.width && v >= 0.0F && v < camera.height);
    seen[i] = valid ? 1 : 0;
    // Exact in single precision: an image has far fewer than 2^24 pixels.
    const float row = static_cast<float>(static_cast<int>(valid ? v : 0.0F));
    const float column = static_cast<float>(static_cast<int>(valid ? u : 0.0F));
    pixel[i] = static_cast<int>(row * camera.width + column);
  }
  unsigned free = 0;
  for (std::size_t i = 0; i < kLeafSide; ++i) {
    free |= static_cast<unsigned>(seen[i] & static_cast<int>(z[i] < camera.depths[pixel[i]])) << i;
  }
  return free;
}

// What a camera sees of cubes of voxels; a cube is its corner (a voxel) and its side in voxels.
// All lengths in camera coordinates are in metres.
class Frustum {
 public:
  Frustum(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
          const Pose& T_world_camera, double resolution_m)
      : pyramid_(free_depth),
        k_(intrinsics),
        resolution_m_(resolution_m),
        T_camera_world_(T_world_camera.inverse()),
        T_world_camera_(T_world_camera),
        flat_{free_depth.pixels().data(),    static_cast<float>(k_.width),
              static_cast<float>(k_.height), static_cast<float>(k_.fx),
              static_cast<float>(k_.fy),     static_cast<float>(k_.cx),
              static_cast<float>(k_.cy)} {}

  // The cubes that could hold free space.
  std::vector<VoxelIndex> root_cubes() const;
  // Appends the free voxels of a cube of at least a block.
  void descend(const VoxelIndex& corner, int side, std::vector<FreeBlock>& out) const;

 private:
  enum class View { none_free, all_free, mixed_inside, mixed };

  View classify(const VoxelIndex& corner, int side) const;
  void test_block(const VoxelIndex& corner, VoxelMask& free) const;
  void test_voxels(const VoxelIndex& corner, bool inside, VoxelMask& free) const;

  DepthPyramid pyramid_;
  CameraIntrinsics k_;
  double resolution_m_;
  Pose T_camera_world_;
  Pose T_world_camera_;
  FlatCamera flat_;
};

std::vector<VoxelIndex> Frustum::root_cubes() const {
  const double far = static_cast<double>(pyramid_.max());
  if (far <= 0.0) return {};
  Box world(T_world_camera_.translation(), T_world_camera_.translation());
  for (const int u : {-1, k_.width}) {
    for (const int v : {-1, k_.height}) world.extend(T_world_camera_ * (far * k_.ray(u, v)));
  }
  const double root_m = kRootSide * resolution_m_;
  const VoxelIndex first = voxel_at(world.min(), root_m);
  const VoxelIndex last = voxel_at(world.max(), root_m);
  std::vector<VoxelIndex> roots;
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        roots.push_back(VoxelIndex(x, y, z) * kRootSide);
      }
    }
  }
  return roots;
}

// Bounds of x / z over x in [low, high], z in [near, far], near > 0.
std::pair<double, double> quotient(double low, double high, double near, double far) {
  return {low / (low < 0.0 ? near : far), high / (high < 0.0 ? far : near)};
}

Frustum::View Frustum::classify(const VoxelIndex& corner, int side) const {
  constexpr double kNearest = 1e-3;
  const double half = 0.5 * side * resolution_m_;
  const Vec3 centre =
      T_camera_world_ * (corner.cast<double>() * resolution_m_ + Vec3::Constant(half));
  // Box around the cube, and only around voxel centres, in the camera frame.
  const Vec3 reach =
      T_camera_world_.linear().cwiseAbs() * Vec3::Constant(half - 0.5 * resolution_m_);
  const Vec3 low = centre - reach;
  const Vec3 high = centre + reach;
  if (high.z() <= 0.0 || low.z() >= static_cast<double>(pyramid_.max())) return View::none_free;
  if (low.z() < kNearest) return View::mixed;
  const auto [x_low, x_high] = quotient(low.x(), high.x(), low.z(), high.z());
  const auto [y_low, y_high] = quotient(low.y(), high.y(), low.z(), high.z());
  // A pixel to spare on every side: voxels are projected in single precision.
  const double u_low = k_.fx * x_low + k_.cx - 1.0;
  const double u_high = k_.fx * x_high + k_.cx + 1.0;
  const double v_low = k_.fy * y_low + k_.cy - 1.0;
  const double v_high = k_.fy * y_high + k_.cy + 1.0;
  if (u_high < 0.0 || v_high < 0.0 || u_low >= k_.width || v_low >= k_.height) {
    return View::none_free;
  }
  const bool inside = u_low >= 0.0 && v_low >= 0.0 && u_high < k_.width && v_high < k_.height;
  const auto pixel = [](double w, int size) {
    return static_cast<int>(std::clamp(w, 0.0, size - 1.0));
  };
  const DepthPyramid::Range depths =
      pyramid_.range(pixel(u_low, k_.width), pixel(v_low, k_.height), pixel(u_high, k_.width),
                     pixel(v_high, k_.height));
  constexpr double kMargin = 1e-5;  // single precision again
  if (low.z() > static_cast<double>(depths.max) + kMargin) return View::none_free;
  if (inside && high.z() < static_cast<double>(depths.min) - kMargin) return View::all_free;
  return inside ? View::mixed_inside : View::mixed;
}

void Frustum::test_voxels(const VoxelIndex& corner, bool inside, VoxelMask& free) const {
  const Vec3 first = T_camera_world_ * voxel_centre(corner, resolution_m_);
  const Eigen::Matrix3d step = T_camera_world_.linear() * resolution_m_;
  const Eigen::Vector3f dx = step.col(0).cast<float>();
  for (int z = 0; z < kLeafSide; ++z) {
    for (int y = 0; y < kLeafSide; ++y) {
      const Eigen::Vector3f p = (first + step.col(1) * y + step.col(2) * z).cast<float>();
      const std::uint64_t row = free_in_row(flat_, p.data(), dx.data(), inside);
      const VoxelIndex start = corner + VoxelIndex(0, y, z);
      free.slices[static_cast<std::size_t>(VoxelMask::slice_of(start))] |=
          row * VoxelMask::bit_of(start);
    }
  }
}

void Frustum::test_block(const VoxelIndex& corner, VoxelMask& free) const {
  for (int child = 0; child < 8; ++child) {
    const VoxelIndex part = corner + VoxelIndex(child & 1, child >> 1 & 1, child >> 2) * kLeafSide;
    const View view = classify(part, kLeafSide);
    if (view == View::none_free) continue;
    if (view != View::all_free) {
      test_voxels(part, view == View::mixed_inside, free);
      continue;
    }
    const std::uint64_t rows = VoxelMask::bit_of(part) * 0x0F0F0F0FU;
    for (std::size_t z = 0; z < kLeafSide; ++z) {
      free.slices[static_cast<std::size_t>(VoxelMask::slice_of(part)) + z] |= rows;
    }
  }
}

void Frustum::descend(const VoxelIndex& corner, int side, std::vector<FreeBlock>& out) const {
  const View view = classify(corner, side);
  if (view == View::none_free) return;
  if (view == View::all_free) {
    for (int z = 0; z < side; z += kBlockSide) {
      for (int y = 0; y < side; y += kBlockSide) {
        for (int x = 0; x < side; x += kBlockSide) {
          out.push_back({block_key(corner + VoxelIndex(x, y, z)), VoxelMask::all()});
        }
      }
    }
    return;
  }
  if (side == kBlockSide) {
    VoxelMask free;
    test_block(corner, free);
    if (free.any()) out.push_back({block_key(corner), free});
    return;
  }
  const int half = side / 2;
  for (int child = 0; child < 8; ++child) {
    descend(corner + VoxelIndex(child & 1, child >> 1 & 1, child >> 2) * half, half, out);
  }
}

}  // namespace

std::vector<FreeBlock> find_free_space(const DepthImage& free_depth,
                                       const CameraIntrinsics& intrinsics,
                                       const Pose& T_world_camera, double resolution_m) {
  const Frustum frustum(free_depth, intrinsics, T_world_camera, resolution_m);
  const std::vector<VoxelIndex> roots = frustum.root_cubes();
  std::vector<std::vector<FreeBlock>> parts(roots.size());
  tbb::parallel_for(std::size_t{0}, roots.size(),
                    [&](std::size_t i) { frustum.descend(roots[i], kRootSide, parts[i]); });
  std::vector<FreeBlock> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace canopeer
