#include "canopeer/map/fusion/crossed_space.h"

#include <algorithm>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/map/fusion/sure_space.h"
#include "canopeer/map/storage/block_directory.h"

namespace canopeer {
namespace {

// The walk of walk_voxels(), that can leap.
class Walker {
 public:
  explicit Walker(const VoxelWalk& walk)
      : at_(walk.first), left_(walk.steps), x_(walk, 0), y_(walk, 1), z_(walk, 2) {}

  // Visits the voxels it is in until `time`, without the last one of the walk.
  template <typename Visit>
  void walk_until(std::int64_t time, Visit&& visit) {
    while (left_ > 0) {
      visit(at_);
      const std::int64_t xy = std::min(x_.t, y_.t);
      if (std::min(xy, z_.t) > time) return;
      const auto x_before_y = -static_cast<std::int64_t>(x_.t < y_.t);
      const auto on_z = -static_cast<std::int64_t>(z_.t < xy);
      const std::int64_t on_x = x_before_y & ~on_z;
      const std::int64_t on_y = ~x_before_y & ~on_z;
      at_.x() += x_.step & static_cast<int>(on_x);
      at_.y() += y_.step & static_cast<int>(on_y);
      at_.z() += z_.step & static_cast<int>(on_z);
      x_.t += x_.dt & on_x;
      y_.t += y_.dt & on_y;
      z_.t += z_.dt & on_z;
      --left_;
    }
  }

  // To the voxel it is in at `time`.
  void leap_to(std::int64_t time) {
    at_.x() += leap(x_, time);
    at_.y() += leap(y_, time);
    at_.z() += leap(z_, time);
  }

 private:
  struct Axis {
    Axis(const VoxelWalk& walk, int axis)
        : t(walk.t_next[axis]), dt(walk.t_delta[axis]), step(walk.step[axis]) {}
    std::int64_t t;   // of the next crossing
    std::int64_t dt;  // between crossings
    int step;
  };

  int leap(Axis& axis, std::int64_t time) {
    if (axis.t > time) return 0;
    const std::int64_t n = (time - axis.t) / axis.dt + 1;
    axis.t += n * axis.dt;
    left_ -= static_cast<int>(n);
    return static_cast<int>(n) * axis.step;
  }

  VoxelIndex at_;
  int left_;
  Axis x_, y_, z_;
};

// Free blocks to which rays add what they cross.
class Crossed {
 public:
  // Adds to `sure`.
  explicit Crossed(FreeSpace& sure) : free_(sure) {
    for (const BlockKey key : free_.whole) directory_.find_or_add(key);
    for (const FreeBlock& part : free_.parts) directory_.find_or_add(part.key);
  }

  void add(const VoxelIndex& voxel) {
    const int beyond =
        ((voxel.x() ^ block_.x()) | (voxel.y() ^ block_.y()) | (voxel.z() ^ block_.z())) >>
        kBlockShift;
    if (beyond != 0 || mask_ == nullptr) enter(voxel);
    mask_->set(voxel);
  }

  // Blocks that became whole are said to be.
  void finish() {
    const auto whole =
        std::stable_partition(free_.parts.begin(), free_.parts.end(),
                              [](const FreeBlock& part) { return !part.free.full(); });
    for (auto part = whole; part != free_.parts.end(); ++part) free_.whole.push_back(part->key);
    free_.parts.erase(whole, free_.parts.end());
  }

 private:
  void enter(const VoxelIndex& voxel) {
    block_ = voxel;
    const BlockKey key = block_key(voxel);
    const std::size_t slot = directory_.find_or_add(key);
    const std::size_t whole = free_.whole.size();
    if (slot < whole) {
      mask_ = &ignored_;
      return;
    }
    if (slot - whole == free_.parts.size()) free_.parts.push_back({key, {}});
    mask_ = &free_.parts[slot - whole].free;
  }

  FreeSpace& free_;
  BlockDirectory directory_;  // whole blocks, then parts
  VoxelIndex block_ = VoxelIndex::Zero();
  VoxelMask* mask_ = nullptr;  // of the block the last voxel was in
  VoxelMask ignored_;
};

}  // namespace

void find_crossed_space(const RgbdFrame& frame, const DepthImage& free_depth, double resolution_m,
                        const FrameKernels& kernels, FreeSpace& free) {
  const SureSpace sure = find_sure_space(free_depth, frame.intrinsics, resolution_m);
  find_free_space(sure.depth, frame.intrinsics, frame.T_world_camera, resolution_m, kernels, free);
  Crossed crossed(free);
  const Vec3 origin = frame.T_world_camera.translation();
  const auto add = [&](const VoxelIndex& voxel) { crossed.add(voxel); };
  for (int v = 0; v < free_depth.height(); ++v) {
    for (int u = 0; u < free_depth.width(); ++u) {
      const double depth = static_cast<double>(free_depth.at(u, v));
      if (depth <= 0.0) continue;
      const Vec3 end = frame.T_world_camera * (depth * frame.intrinsics.ray(u, v));
      Walker walker(VoxelWalk(origin, end, resolution_m));
      const double from = static_cast<double>(sure.from.at(u, v));
      const double to = static_cast<double>(sure.to.at(u, v));
      const auto time = [depth](double z) {
        return static_cast<std::int64_t>(z / depth * static_cast<double>(VoxelWalk::kEnd));
      };
      if (to > from) {
        walker.walk_until(time(from), add);
        walker.leap_to(time(to));
      }
      walker.walk_until(VoxelWalk::kEnd, add);
    }
  }
  crossed.finish();
}

}  // namespace canopeer
