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
  int width, height;
  float fx, fy, cx, cy;
};

// One slice of a leaf cube: its voxels in a vector loop.
constexpr std::size_t kSliceVoxels = kLeafSide * kLeafSide;

// Where the voxels of a slice are, relative to its first one, camera frame.
struct SliceOffsets {
  std::array<float, kSliceVoxels> x, y, z;
};

// Which voxels of a slice (bit y · kLeafSide + x) are seen nearer than the depth at the pixel their
// centre falls on; the first centre is (x, y, z). Every centre must project into the image.
__attribute__((target_clones("avx2", "default"))) unsigned free_in_slice_inside(
    const FlatCamera& camera, float x, float y, float z, const SliceOffsets& offsets) {
  std::array<float, kSliceVoxels> depth;
  std::array<int, kSliceVoxels> pixel;
  for (std::size_t i = 0; i < kSliceVoxels; ++i) {
    depth[i] = z + offsets.z[i];
    const float inverse = 1.0F / depth[i];
    const float u = camera.fx * (x + offsets.x[i]) * inverse + camera.cx;
    const float v = camera.fy * (y + offsets.y[i]) * inverse + camera.cy;
    pixel[i] = static_cast<int>(v) * camera.width + static_cast<int>(u);
  }
  unsigned free = 0;
  for (std::size_t i = 0; i < kSliceVoxels; ++i) {
    free |= static_cast<unsigned>(depth[i] < camera.depths[pixel[i]]) << i;
  }
  return free;
}

// The same for centres that may fall beside the image or lie behind the camera: those are not free.
unsigned free_in_slice(const FlatCamera& camera, float x, float y, float z,
                       const SliceOffsets& offsets) {
  unsigned free = 0;
  for (std::size_t i = 0; i < kSliceVoxels; ++i) {
    const float depth = z + offsets.z[i];
    if (depth <= 0.0F) continue;
    const float inverse = 1.0F / depth;
    const float u = camera.fx * (x + offsets.x[i]) * inverse + camera.cx;
    const float v = camera.fy * (y + offsets.y[i]) * inverse + camera.cy;
    const bool seen = u >= 0.0F && u < static_cast<float>(camera.width) && v >= 0.0F &&
                      v < static_cast<float>(camera.height);
    if (!seen) continue;
    const int pixel = static_cast<int>(v) * camera.width + static_cast<int>(u);
    free |= static_cast<unsigned>(depth < camera.depths[pixel]) << i;
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
        flat_{free_depth.pixels().data(),
              k_.width,
              k_.height,
              static_cast<float>(k_.fx),
              static_cast<float>(k_.fy),
              static_cast<float>(k_.cx),
              static_cast<float>(k_.cy)} {
    const Eigen::Matrix3d step = T_camera_world_.linear() * resolution_m_;
    for (int i = 0; i < static_cast<int>(kSliceVoxels); ++i) {
      const Vec3 offset = step.col(0) * (i % kLeafSide) + step.col(1) * (i / kLeafSide);
      offsets_.x[static_cast<std::size_t>(i)] = static_cast<float>(offset.x());
      offsets_.y[static_cast<std::size_t>(i)] = static_cast<float>(offset.y());
      offsets_.z[static_cast<std::size_t>(i)] = static_cast<float>(offset.z());
    }
  }

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
  SliceOffsets offsets_;
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
  const auto test = inside ? free_in_slice_inside : free_in_slice;
  for (int z = 0; z < kLeafSide; ++z) {
    const VoxelIndex start = corner + VoxelIndex(0, 0, z);
    const Eigen::Vector3f p = (T_camera_world_ * voxel_centre(start, resolution_m_)).cast<float>();
    const std::uint64_t rows = test(flat_, p.x(), p.y(), p.z(), offsets_);
    // Rows of 4 bits spread to the 8 a mask has.
    const std::uint64_t spread =
        (rows & 0xF) | (rows & 0xF0) << 4 | (rows & 0xF00) << 8 | (rows & 0xF000) << 12;
    free.slices[static_cast<std::size_t>(VoxelMask::slice_of(start))] |=
        spread * VoxelMask::bit_of(start);
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
