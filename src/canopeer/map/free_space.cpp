#include "canopeer/map/free_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>

#include "canopeer/map/block_directory.h"
#include "canopeer/map/depth_pyramid.h"

namespace canopeer {
namespace {

constexpr int kChunkBlocks = 1 << BlockDirectory::kChunkShift;  // a side
constexpr int kChunkSide = kChunkBlocks * kBlockSide;           // voxels
// Voxels are tested one by one in half blocks: near leaves much of a block lies clear of the
// surface.
constexpr int kPartSide = kBlockSide / 2;

// Cubes of one size side by side: where their centres are from the first voxel's corner, camera
// frame, and half the box around their voxels' centres.
struct CubePattern {
  CubePattern(const Eigen::Matrix3d& R_camera_world, int cubes_a_side, int side,
              double resolution_m) {
    const Eigen::Matrix3d step = R_camera_world * (side * resolution_m);
    const auto n = static_cast<std::size_t>(cubes_a_side);
    count = n * n * n;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 at(static_cast<double>(i % n), static_cast<double>(i / n % n),
                    static_cast<double>(i / n / n));
      const Eigen::Vector3f offset = (step * (at.array() + 0.5).matrix()).cast<float>();
      x[i] = offset.x();
      y[i] = offset.y();
      z[i] = offset.z();
    }
    const Eigen::Vector3f box =
        (R_camera_world.cwiseAbs() * Vec3::Constant(0.5 * (side - 1) * resolution_m)).cast<float>();
    half = {box.x(), box.y(), box.z()};
  }

  // The cubes when the first voxel's corner lies at `corner`, as lanes first, first + 1 …
  void place(const Eigen::Vector3f& corner, CubeLanes& lanes, std::size_t first) const {
    for (std::size_t i = 0; i < count; ++i) {
      lanes.x[first + i] = corner.x() + x[i];
      lanes.y[first + i] = corner.y() + y[i];
      lanes.z[first + i] = corner.z() + z[i];
    }
    lanes.count = first + count;
    lanes.half = half;
  }

  std::size_t count = 0;
  std::array<float, CubeLanes::kMax> x{}, y{}, z{};
  std::array<float, 3> half{};
};

// What a camera sees of the map's chunks, blocks and voxels. All lengths in camera coordinates are
// in metres.
class Frustum {
 public:
  Frustum(const FlatPyramid& pyramid, const CameraIntrinsics& intrinsics,
          const Pose& T_world_camera, double resolution_m, const FrameKernels& kernels)
      : pyramid_(pyramid),
        k_(intrinsics),
        resolution_m_(resolution_m),
        T_camera_world_(T_world_camera.inverse()),
        T_world_camera_(T_world_camera),
        kernels_(kernels),
        chunk_(T_camera_world_.linear(), 1, kChunkSide, resolution_m),
        blocks_(T_camera_world_.linear(), kChunkBlocks, kBlockSide, resolution_m),
        parts_(T_camera_world_.linear(), 2, kPartSide, resolution_m) {
    const Eigen::Matrix3d step = T_camera_world_.linear() * resolution_m_;
    for (int i = 0; i < kPartSide * kPartSide; ++i) {
      const Vec3 offset = step.col(0) * (i % kPartSide) + step.col(1) * (i / kPartSide);
      slice_.x[static_cast<std::size_t>(i)] = static_cast<float>(offset.x());
      slice_.y[static_cast<std::size_t>(i)] = static_cast<float>(offset.y());
      slice_.z[static_cast<std::size_t>(i)] = static_cast<float>(offset.z());
    }
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        rows_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
            T_camera_world_.matrix()(row, column);
      }
    }
  }

  // First voxels of the chunks that could hold free space.
  [[nodiscard]] std::vector<VoxelIndex> chunks() const;
  // Appends what of some chunks (at most 64) is free.
  void find(std::span<const VoxelIndex> chunks, FreeSpace& out) const;

 private:
  [[nodiscard]] Eigen::Vector3f in_camera(const VoxelIndex& corner) const {
    return (T_camera_world_ * (corner.cast<double>() * resolution_m_)).cast<float>();
  }
  void find_in_chunk(const VoxelIndex& corner, FreeSpace& out) const;
  // Appends what of some blocks (at most 8) is free, looked at in half blocks.
  void find_in_blocks(std::span<const BlockKey> keys, FreeSpace& out) const;
  [[nodiscard]] VoxelMask free_in_block(const VoxelIndex& corner, unsigned none_free,
                                        unsigned all_free) const;
  [[nodiscard]] std::uint64_t free_in_part(const VoxelIndex& corner) const;

  const FlatPyramid& pyramid_;
  CameraIntrinsics k_;
  double resolution_m_;
  Pose T_camera_world_;
  Pose T_world_camera_;
  const FrameKernels& kernels_;
  CubePattern chunk_;
  CubePattern blocks_;
  CubePattern parts_;
  SliceOffsets slice_;
  std::array<std::array<double, 4>, 3> rows_;  // of T_camera_world
};

std::vector<VoxelIndex> Frustum::chunks() const {
  const double far = static_cast<double>(pyramid_.largest);
  if (far <= 0.0) return {};
  Box world(T_world_camera_.translation(), T_world_camera_.translation());
  for (const int u : {-1, k_.width}) {
    for (const int v : {-1, k_.height}) world.extend(T_world_camera_ * (far * k_.ray(u, v)));
  }
  const double chunk_m = kChunkSide * resolution_m_;
  const VoxelIndex first = voxel_at(world.min(), chunk_m);
  const VoxelIndex last = voxel_at(world.max(), chunk_m);
  std::vector<VoxelIndex> chunks;
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        chunks.push_back(VoxelIndex(x, y, z) * kChunkSide);
      }
    }
  }
  return chunks;
}

void Frustum::find(std::span<const VoxelIndex> chunks, FreeSpace& out) const {
  CubeLanes lanes;
  for (std::size_t i = 0; i < (chunks.size() + 7) / 8 * 8; ++i) {
    chunk_.place(in_camera(chunks[std::min(i, chunks.size() - 1)]), lanes, i);
  }
  const CubeViews views = kernels_.classify(pyramid_, lanes);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if ((views.none_free >> i & 1) != 0) continue;
    if ((views.all_free >> i & 1) == 0) {
      find_in_chunk(chunks[i], out);
      continue;
    }
    const BlockKey key = block_key(chunks[i]);
    for (std::size_t block = 0; block < BlockDirectory::kChunkBlocks; ++block) {
      out.whole.push_back(BlockDirectory::key_in_chunk(key, block));
    }
  }
}

void Frustum::find_in_chunk(const VoxelIndex& corner, FreeSpace& out) const {
  CubeLanes lanes;
  blocks_.place(in_camera(corner), lanes, 0);
  const CubeViews views = kernels_.classify(pyramid_, lanes);
  const BlockKey chunk_key = block_key(corner);
  std::array<BlockKey, CubeLanes::kMax / 8> mixed;
  std::size_t count = 0;
  for (std::uint64_t bits = ~views.none_free; bits != 0; bits &= bits - 1) {
    const auto place = static_cast<std::size_t>(std::countr_zero(bits));
    const BlockKey key = BlockDirectory::key_in_chunk(chunk_key, place);
    if ((views.all_free >> place & 1) != 0) {
      out.whole.push_back(key);
      continue;
    }
    mixed[count++] = key;
    if (count < mixed.size()) continue;
    find_in_blocks(mixed, out);
    count = 0;
  }
  find_in_blocks(std::span(mixed).first(count), out);
}

void Frustum::find_in_blocks(std::span<const BlockKey> keys, FreeSpace& out) const {
  if (keys.empty()) return;
  CubeLanes lanes;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    parts_.place(in_camera(block_origin(keys[i])), lanes, i * parts_.count);
  }
  const CubeViews views = kernels_.classify(pyramid_, lanes);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto none_free = static_cast<unsigned>(views.none_free >> (8 * i) & 0xFF);
    const auto all_free = static_cast<unsigned>(views.all_free >> (8 * i) & 0xFF);
    if (none_free == 0xFF) continue;
    const VoxelMask free = free_in_block(block_origin(keys[i]), none_free, all_free);
    if (free.full()) {
      out.whole.push_back(keys[i]);
    } else if (free.any()) {
      out.parts.push_back({keys[i], free});
    }
  }
}

// Bits of half blocks: x, y, z of the half from the lowest bit on.
VoxelMask Frustum::free_in_block(const VoxelIndex& corner, unsigned none_free,
                                 unsigned all_free) const {
  VoxelMask free;
  for (int i = 0; i < 8; ++i) {
    if ((none_free >> i & 1) != 0) continue;
    const VoxelIndex part = corner + VoxelIndex(i & 1, i >> 1 & 1, i >> 2) * kPartSide;
    const std::uint64_t seen = (all_free >> i & 1) != 0 ? ~std::uint64_t{0} : free_in_part(part);
    const std::uint64_t first = VoxelMask::bit_of(part);
    for (int z = 0; z < kPartSide; ++z) {
      // Rows of 4 bits spread to the 8 a mask has.
      const std::uint64_t rows = seen >> (16 * z) & 0xFFFF;
      const std::uint64_t spread =
          (rows & 0xF) | (rows & 0xF0) << 4 | (rows & 0xF00) << 8 | (rows & 0xF000) << 12;
      free.slices[static_cast<std::size_t>(VoxelMask::slice_of(part) + z)] |= spread * first;
    }
  }
  return free;
}

std::uint64_t Frustum::free_in_part(const VoxelIndex& corner) const {
  const auto centre = [&](int axis, int steps) {
    return (corner[axis] + steps + 0.5) * resolution_m_;
  };
  const double x = centre(0, 0);
  const double y = centre(1, 0);
  std::array<double, kPartSide> z;
  for (std::size_t slice = 0; slice < kPartSide; ++slice) {
    z[slice] = centre(2, static_cast<int>(slice));
  }
  const auto project = [&](std::size_t axis, std::array<float, kPartSide>& out) {
    const auto& row = rows_[axis];
    const double across = row[0] * x + row[1] * y;
    for (std::size_t slice = 0; slice < kPartSide; ++slice) {
      out[slice] = static_cast<float>(across + row[2] * z[slice] + row[3]);
    }
  };
  VoxelLanes voxels;
  project(0, voxels.x);
  project(1, voxels.y);
  project(2, voxels.z);
  return kernels_.seen_free(pyramid_, voxels, slice_);
}

}  // namespace

FreeSpace find_free_space(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
                          const Pose& T_world_camera, double resolution_m,
                          const FrameKernels& kernels) {
  const DepthPyramid pyramid(free_depth, intrinsics, kernels);
  const Frustum frustum(pyramid.flat(), intrinsics, T_world_camera, resolution_m, kernels);
  const std::vector<VoxelIndex> chunks = frustum.chunks();
  constexpr std::size_t kBatch = 32;
  std::vector<FreeSpace> found((chunks.size() + kBatch - 1) / kBatch);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const std::size_t first = i * kBatch;
    const std::size_t count = std::min(kBatch, chunks.size() - first);
    frustum.find(std::span(chunks).subspan(first, count), found[i]);
  });
  FreeSpace all;
  for (const FreeSpace& part : found) {
    all.whole.insert(all.whole.end(), part.whole.begin(), part.whole.end());
    all.parts.insert(all.parts.end(), part.parts.begin(), part.parts.end());
  }
  return all;
}

}  // namespace canopeer
