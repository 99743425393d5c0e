#include "canopeer/map/free_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "canopeer/map/depth_pyramid.h"

namespace canopeer {
namespace {

constexpr int kRootBlocks = 8;  // side of the cubes the descent starts from

// A camera that looks at cubes of blocks. All lengths in camera coordinates are in metres.
class Frustum {
 public:
  Frustum(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
          const Pose& T_world_camera, double resolution_m)
      : depth_(free_depth),
        pyramid_(free_depth),
        k_(intrinsics),
        resolution_m_(resolution_m),
        T_camera_world_(T_world_camera.inverse()),
        T_world_camera_(T_world_camera) {}

  // The blocks that could hold free space, as root cubes.
  std::vector<VoxelIndex> root_cubes() const;
  // Appends the free voxels of the cube of `side`³ blocks at block index `corner`.
  void descend(const VoxelIndex& corner, int side, std::vector<FreeBlock>& out) const;

 private:
  enum class View { none_free, all_free, mixed };

  View classify(const VoxelIndex& corner, int side) const;
  VoxelMask free_voxels(const VoxelIndex& block) const;

  const DepthImage& depth_;
  DepthPyramid pyramid_;
  CameraIntrinsics k_;
  double resolution_m_;
  Pose T_camera_world_;
  Pose T_world_camera_;
};

std::vector<VoxelIndex> Frustum::root_cubes() const {
  const double far = static_cast<double>(pyramid_.max());
  if (far <= 0.0) return {};
  Box world(T_world_camera_.translation(), T_world_camera_.translation());
  for (const int u : {-1, k_.width}) {
    for (const int v : {-1, k_.height}) world.extend(T_world_camera_ * (far * k_.ray(u, v)));
  }
  const double root_m = kRootBlocks * kBlockSide * resolution_m_;
  const VoxelIndex first = voxel_at(world.min(), root_m);
  const VoxelIndex last = voxel_at(world.max(), root_m);
  std::vector<VoxelIndex> roots;
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        roots.push_back(VoxelIndex(x, y, z) * kRootBlocks);
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
  const double half = 0.5 * side * kBlockSide * resolution_m_;
  const Vec3 centre =
      T_camera_world_ * (corner.cast<double>() * kBlockSide * resolution_m_ + Vec3::Constant(half));
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
  return View::mixed;
}

// One row of 8 voxels along x: which pixel each centre falls on (−1: none).
struct Row {
  std::array<float, kBlockSide> x, y, z;
};

VoxelMask Frustum::free_voxels(const VoxelIndex& block) const {
  const Vec3 first = T_camera_world_ * voxel_centre(block * kBlockSide, resolution_m_);
  const Eigen::Matrix3d step = T_camera_world_.linear() * resolution_m_;
  const auto width = static_cast<float>(k_.width);
  const auto height = static_cast<float>(k_.height);
  const auto fx = static_cast<float>(k_.fx);
  const auto fy = static_cast<float>(k_.fy);
  const auto cx = static_cast<float>(k_.cx);
  const auto cy = static_cast<float>(k_.cy);
  const Eigen::Vector3f dx = step.col(0).cast<float>();
  const float* depths = depth_.pixels().data();
  VoxelMask free;
  for (int z = 0; z < kBlockSide; ++z) {
    std::uint64_t slice = 0;
    for (int y = 0; y < kBlockSide; ++y) {
      const Eigen::Vector3f row = (first + step.col(1) * y + step.col(2) * z).cast<float>();
      std::array<float, kBlockSide> us;
      std::array<float, kBlockSide> vs;
      std::array<float, kBlockSide> zs;
      for (int x = 0; x < kBlockSide; ++x) {
        const auto i = static_cast<std::size_t>(x);
        const auto t = static_cast<float>(x);
        zs[i] = row.z() + t * dx.z();
        const float inverse = 1.0F / zs[i];
        us[i] = fx * (row.x() + t * dx.x()) * inverse + cx;
        vs[i] = fy * (row.y() + t * dx.y()) * inverse + cy;
      }
      for (int x = 0; x < kBlockSide; ++x) {
        const auto i = static_cast<std::size_t>(x);
        const bool seen =
            zs[i] > 0.0F && us[i] >= 0.0F && us[i] < width && vs[i] >= 0.0F && vs[i] < height;
        if (!seen) continue;
        const int pixel = static_cast<int>(vs[i]) * k_.width + static_cast<int>(us[i]);
        slice |= std::uint64_t{zs[i] < depths[pixel]} << (y * kBlockSide + x);
      }
    }
    free.slices[static_cast<std::size_t>(z)] = slice;
  }
  return free;
}

void Frustum::descend(const VoxelIndex& corner, int side, std::vector<FreeBlock>& out) const {
  const View view = classify(corner, side);
  if (view == View::none_free) return;
  if (view == View::all_free) {
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          out.push_back(
              {pack_block(corner.x() + x, corner.y() + y, corner.z() + z), VoxelMask::all()});
        }
      }
    }
    return;
  }
  if (side == 1) {
    const VoxelMask free = free_voxels(corner);
    if (free.any()) out.push_back({pack_block(corner.x(), corner.y(), corner.z()), free});
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
                    [&](std::size_t i) { frustum.descend(roots[i], kRootBlocks, parts[i]); });
  std::vector<FreeBlock> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace canopeer
