#include "canopeer/map/fusion/free_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>

#include "canopeer/map/fusion/depth_pyramid.h"
#include "canopeer/map/storage/block_directory.h"
#include "canopeer/map/storage/kept.h"

namespace canopeer {
namespace {

constexpr int kChunkBlocks = 1 << BlockDirectory::kChunkShift;  // a side
constexpr int kChunkSide = kChunkBlocks * kBlockSide;           // voxels
// Voxels are tested one by one in half blocks: near leaves much of a block lies clear of the
// surface.
constexpr int kPartSide = kBlockSide / 2;

// Cubes of one size side by side: where their centres are from the first voxel's corner, and the
// half edges between their voxels' centres; camera frame.
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
    const Eigen::Matrix3f half_edges =
        (R_camera_world * (0.5 * (side - 1) * resolution_m)).cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      edges[axis] = {half_edges(0, axis), half_edges(1, axis), half_edges(2, axis)};
    }
    half = half_edges.row(2).cwiseAbs().sum();
  }

  // The cubes when the first voxel's corner lies at `corner`, as lanes first, first + 1 …
  void place(const Eigen::Vector3f& corner, CubeLanes& lanes, std::size_t first) const {
    for (std::size_t i = 0; i < count; ++i) {
      lanes.x[first + i] = corner.x() + x[i];
      lanes.y[first + i] = corner.y() + y[i];
      lanes.z[first + i] = corner.z() + z[i];
    }
    lanes.count = first + count;
    lanes.edges = edges;
    lanes.half = half;
  }

  std::size_t count = 0;
  std::array<float, CubeLanes::kMax> x{}, y{}, z{};
  std::array<std::array<float, 3>, 3> edges{};
  float half = 0;
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
      projection_.x[static_cast<std::size_t>(i)] = static_cast<float>(offset.x());
      projection_.y[static_cast<std::size_t>(i)] = static_cast<float>(offset.y());
      projection_.z[static_cast<std::size_t>(i)] = static_cast<float>(offset.z());
    }
    const auto [least, most] = std::minmax_element(projection_.z.begin(), projection_.z.end());
    projection_.z_least = *least;
    projection_.z_most = *most;
    projection_.resolution_m = resolution_m;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        projection_.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
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

  const FlatPyramid& pyramid_;
  CameraIntrinsics k_;
  double resolution_m_;
  Pose T_camera_world_;
  Pose T_world_camera_;
  const FrameKernels& kernels_;
  CubePattern chunk_;
  CubePattern blocks_;
  CubePattern parts_;
  BlockProjection projection_;
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
  PixelRects rects;
  const CubeViews views = kernels_.classify(pyramid_, lanes, rects);
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
  PixelRects rects;
  const CubeViews views = kernels_.classify(pyramid_, lanes, rects);
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
  PixelRects rects;
  const CubeViews views = kernels_.classify(pyramid_, lanes, rects);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const HalfBlocks halves{views, rects, i};
    if (halves.none_free() == 0xFF) continue;
    const VoxelIndex corner = block_origin(keys[i]);
    const VoxelMask free =
        kernels_.free_in_block(pyramid_, projection_, {corner.x(), corner.y(), corner.z()}, halves);
    if (free.full()) {
      out.whole.push_back(keys[i]);
    } else if (free.any()) {
      out.parts.push_back({keys[i], free});
    }
  }
}

}  // namespace

void find_free_space(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
                     const Pose& T_world_camera, double resolution_m, const FrameKernels& kernels,
                     FreeSpace& free) {
  const DepthPyramid pyramid(free_depth, intrinsics, kernels);
  const Frustum frustum(pyramid.flat(), intrinsics, T_world_camera, resolution_m, kernels);
  const std::vector<VoxelIndex> chunks = frustum.chunks();
  constexpr std::size_t kBatch = 32;
  const std::size_t batches = (chunks.size() + kBatch - 1) / kBatch;
  Kept<std::vector<FreeSpace>> kept;
  if (kept->size() < batches) kept->resize(batches);
  const auto found = std::span(*kept).first(batches);
  tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t i) {
    const std::size_t first = i * kBatch;
    const std::size_t count = std::min(kBatch, chunks.size() - first);
    found[i].whole.clear();
    found[i].parts.clear();
    frustum.find(std::span(chunks).subspan(first, count), found[i]);
  });
  free.whole.clear();
  free.parts.clear();
  for (const FreeSpace& part : found) {
    free.whole.insert(free.whole.end(), part.whole.begin(), part.whole.end());
    free.parts.insert(free.parts.end(), part.parts.begin(), part.parts.end());
  }
}

}  // namespace canopeer
