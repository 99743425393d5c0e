#include "canopeer/map/fusion/end_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

void check(const RgbdFrame& frame, const Mask& roi, const FusionOptions& options,
           double resolution_m) {
  const CameraIntrinsics& k = frame.intrinsics;
  CANOPEER_CHECK(frame.depth.width() == k.width && frame.depth.height() == k.height,
                 "the depth image must have the size the intrinsics say");
  CANOPEER_CHECK(roi.empty() || (roi.width() == k.width && roi.height() == k.height),
                 "the ROI mask must be empty or as large as the depth image");
  CANOPEER_CHECK(frame.T_world_camera.matrix().allFinite(), "the camera pose must be finite");
  const double reach =
      frame.T_world_camera.translation().cwiseAbs().maxCoeff() + options.max_range_m;
  CANOPEER_CHECK(reach / resolution_m < kBlockSide * (kBlockIndexLimit - 2.0),
                 "the camera is outside the map's index range");
}

// Rows of pixels on their way, and room for what comes out: this row's and that of the one above.
class RowProjection {
 public:
  RowProjection(const RgbdFrame& frame, const Mask& roi, bool graded, const FusionOptions& options,
                double resolution_m)
      : frame_(frame), roi_(roi), R_(frame.T_world_camera.linear()) {
    const CameraIntrinsics& k = frame.intrinsics;
    const auto width = static_cast<std::size_t>(k.width);
    for (auto* doubles : {&across_x_, &across_y_, &across_z_, &across2_}) doubles->resize(width);
    for (Ends* ends : {&ends_, &above_}) {
      for (auto* ints : {&ends->x, &ends->y, &ends->z, &ends->is_end, &ends->label}) {
        ints->resize(width);
      }
    }
    first_.resize((width + 63) / 64);
    // The part of a ray's direction that depends on its column, and its square in the camera frame.
    for (std::size_t u = 0; u < width; ++u) {
      const double x = k.ray(static_cast<int>(u), 0).x();
      const Vec3 across = R_.col(0) * x;
      across_x_[u] = across.x();
      across_y_[u] = across.y();
      across_z_[u] = across.z();
      across2_[u] = x * x;
    }
    const Vec3 origin = frame.T_world_camera.translation();
    row_.width = width;
    row_.across_x = across_x_.data();
    row_.across_y = across_y_.data();
    row_.across_z = across_z_.data();
    row_.across2 = across2_.data();
    row_.origin = {origin.x(), origin.y(), origin.z()};
    row_.max_range_m = options.max_range_m;
    row_.resolution_m = resolution_m;
    row_.clear_no_return = options.clear_no_return;
    labelled_.width = width;
    labelled_.most = graded ? 255 : 1;
  }

  // Rows in turn, from the upper one on.
  void project(int v, float* free_depth, const FrameKernels& kernels) {
    const double y = frame_.intrinsics.ray(0, v).y();
    const Vec3 along = R_.col(1) * y + R_.col(2);
    row_.depth = &frame_.depth.at(0, v);
    row_.along = {along.x(), along.y(), along.z()};
    row_.along2 = 1.0 + y * y;
    std::swap(ends_, above_);
    kernels.end_point_row(row_, ends_.flat(free_depth));
    labelled_.ends = ends_.flat(free_depth);
    labelled_.above = above_.flat(nullptr);
    labelled_.mask = roi_.empty() ? nullptr : &roi_.at(0, v);
    labelled_.label = ends_.label.data();
    labelled_.label_above = above_.label.data();
    kernels.first_pixels(labelled_, first_.data());
  }

  [[nodiscard]] std::int64_t count() const {
    std::int32_t count = 0;
    for (const std::int32_t is_end : ends_.is_end) count += is_end;
    return count;
  }

  // `visit(u, VoxelIndex)` for the end points, but for those that say what the pixel to the left or
  // above has said.
  template <typename Visit>
  void for_each_new(Visit&& visit) const {
    for (std::size_t i = 0; i < first_.size(); ++i) {
      for (std::uint64_t bits = first_[i]; bits != 0; bits &= bits - 1) {
        const std::size_t u = 64 * i + static_cast<std::size_t>(std::countr_zero(bits));
        visit(u, VoxelIndex(ends_.x[u], ends_.y[u], ends_.z[u]));
      }
    }
  }

 private:
  struct Ends {
    std::vector<std::int32_t> x, y, z, is_end, label;
    PixelRowEnds flat(float* free_depth) {
      return {free_depth, x.data(), y.data(), z.data(), is_end.data()};
    }
  };

  const RgbdFrame& frame_;
  const Mask& roi_;
  Eigen::Matrix3d R_;
  PixelRow row_;
  std::vector<double> across_x_, across_y_, across_z_, across2_;
  LabelledRow labelled_;
  Ends ends_, above_;
  std::vector<std::uint64_t> first_;
};

// A directory whose latest answers are at hand: an image's rows come by the same blocks again and
// again.
class RecentBlocks {
 public:
  explicit RecentBlocks(BlockDirectory& directory) : directory_(directory) {
    entries_.fill({~BlockKey{0}, 0});
  }
  std::uint32_t find_or_add(BlockKey key) {
    Entry& entry = entries_[(key ^ key >> 18 ^ key >> 36) % kEntries];
    if (entry.key != key) entry = {key, directory_.find_or_add(key)};
    return entry.slot;
  }

 private:
  static constexpr std::size_t kEntries = 512;  // three bits of each index
  struct Entry {
    BlockKey key;
    std::uint32_t slot;
  };
  BlockDirectory& directory_;
  std::array<Entry, kEntries> entries_;
};

}  // namespace

void find_end_points(const RgbdFrame& frame, const Mask& roi, const FusionOptions& options,
                     double resolution_m, const FrameKernels& kernels, EndPoints& ends) {
  check(frame, roi, options, resolution_m);
  const CameraIntrinsics& k = frame.intrinsics;
  const bool graded = options.roi_is_confidence && !roi.empty();
  ends.count = 0;
  ends.directory = BlockDirectory();
  ends.blocks.clear();
  ends.confidences.clear();
  if (ends.free_depth.width() != k.width || ends.free_depth.height() != k.height) {
    ends.free_depth = DepthImage(k.width, k.height);
  }
  RowProjection row(frame, roi, graded, options, resolution_m);
  BlockKey key = ~BlockKey{0};
  std::uint32_t slot = 0;
  RecentBlocks recent(ends.directory);
  for (int v = 0; v < k.height; ++v) {
    row.project(v, &ends.free_depth.at(0, v), kernels);
    ends.count += row.count();
    const std::uint8_t* roi_row = roi.empty() ? nullptr : &roi.at(0, v);
    row.for_each_new([&](std::size_t u, const VoxelIndex& voxel) {
      if (const BlockKey now = block_key(voxel); now != key) {
        key = now;
        slot = recent.find_or_add(key);
        if (slot == ends.blocks.size()) {
          ends.blocks.push_back({key, {}, {}});
          if (graded) ends.confidences.push_back({});
        }
      }
      ends.blocks[slot].hit.set(voxel);
      if (roi_row == nullptr || roi_row[u] == 0) return;
      ends.blocks[slot].roi.set(voxel);
      if (!graded) return;
      std::uint8_t& confidence = ends.confidences[slot][voxel_offset(voxel)];
      confidence = std::max(confidence, roi_row[u]);
    });
  }
}

}  // namespace canopeer
