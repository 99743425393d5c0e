#include "canopeer/map/cloud_fusion.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

// What rays say about the blocks they cross. Gathered by each thread for itself; joining is by OR,
// so it does not matter which thread walked which ray.
class ScanBlocks {
 public:
  BlockUpdate& at(BlockKey key) {
    if (blocks_.empty() || key != blocks_[last_].key) {
      last_ = directory_.find_or_add(key);
      if (last_ == blocks_.size()) blocks_.emplace_back().key = key;
    }
    return blocks_[last_];
  }
  void join(const ScanBlocks& other) {
    for (const BlockUpdate& block : other.blocks_) {
      BlockUpdate& mine = at(block.key);
      mine.hit |= block.hit;
      mine.miss |= block.miss;
      mine.roi_hit |= block.roi_hit;
      mine.roi_miss |= block.roi_miss;
    }
    points += other.points;
  }
  // Sorted, so that new blocks of the map come in one order; a hit beats a miss.
  std::vector<BlockUpdate> updates() && {
    for (BlockUpdate& block : blocks_) {
      block.miss -= block.hit;
      block.roi_miss -= block.roi_hit;
    }
    std::sort(blocks_.begin(), blocks_.end(),
              [](const BlockUpdate& a, const BlockUpdate& b) { return a.key < b.key; });
    return std::move(blocks_);
  }

  std::int64_t points = 0;  // that were end points

 private:
  BlockDirectory directory_;
  std::vector<BlockUpdate> blocks_;
  std::uint32_t last_ = 0;
};

class ScanFusion {
 public:
  ScanFusion(const CloudScan& scan, const CloudFusionOptions& options, double resolution_m)
      : scan_(scan),
        options_(options),
        resolution_m_(resolution_m),
        origin_(scan.T_world_points * scan.origin) {}

  void add(std::size_t i, ScanBlocks& blocks) const {
    if (!scan_.points[i].allFinite()) return;
    const Vec3 p = scan_.T_world_points * scan_.points[i].cast<double>();
    const double range = (p - origin_).norm();
    if (!(range > 0.0 && range >= options_.min_range_m && range < kNoReturn_m)) return;
    if (range > options_.max_range_m) {
      free_ray(origin_ + (p - origin_) * (options_.max_range_m / range), blocks);
      return;
    }
    free_ray(p, blocks);
    const VoxelIndex voxel = voxel_at(p, resolution_m_);
    BlockUpdate& block = blocks.at(block_key(voxel));
    block.hit.set(voxel);
    ++blocks.points;
    if (scan_.roi_confidence.empty() || std::isnan(scan_.roi_confidence[i])) return;
    const bool fruit = scan_.roi_confidence[i] >= options_.min_roi_confidence;
    (fruit ? block.roi_hit : block.roi_miss).set(voxel);
  }

 private:
  void free_ray(const Vec3& end, ScanBlocks& blocks) const {
    const VoxelIndex last = voxel_at(end, resolution_m_);
    walk_voxels(origin_, end, resolution_m_, [&](const VoxelIndex& voxel) {
      if (voxel == last) return false;
      blocks.at(block_key(voxel)).miss.set(voxel);
      return true;
    });
  }

  const CloudScan& scan_;
  const CloudFusionOptions& options_;
  double resolution_m_;
  Vec3 origin_;
};

}  // namespace

Expected<void> CloudFusionOptions::validate() const {
  if (!(min_range_m >= 0.0 && std::isfinite(max_range_m) && max_range_m > min_range_m)) {
    return fail("0 <= min_range_m < max_range_m must hold");
  }
  return {};
}

Expected<void> check_placement(const VoxelMap& map, const CloudScan& scan,
                               const CloudFusionOptions& options) {
  if (!scan.T_world_points.matrix().allFinite() || !scan.origin.allFinite()) {
    return fail("the pose is not finite");
  }
  const double reach =
      (scan.T_world_points * scan.origin).cwiseAbs().maxCoeff() + options.max_range_m;
  const double limit = kBlockSide * (kBlockIndexLimit - 2.0) * map.resolution_m();
  if (!(reach < limit)) {
    return fail("the sensor and its range lie beyond the " +
                std::to_string(static_cast<long long>(limit)) +
                " m from the origin that the map can hold at this resolution");
  }
  return {};
}

FuseResult fuse_cloud(VoxelMap& map, const CloudScan& scan, const CloudFusionOptions& options) {
  CANOPEER_CHECK(options.validate().has_value(), "CloudFusionOptions must be valid");
  CANOPEER_CHECK(check_placement(map, scan, options).has_value(), "the scan must fit the map");
  CANOPEER_CHECK(scan.roi_confidence.empty() || scan.roi_confidence.size() == scan.points.size(),
                 "one ROI confidence per point, or none");
  constexpr std::size_t kGrain = 512;
  const ScanFusion fusion(scan, options, map.resolution_m());
  tbb::enumerable_thread_specific<ScanBlocks> parts;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scan.points.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      ScanBlocks& blocks = parts.local();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        fusion.add(i, blocks);
                      }
                    });
  ScanBlocks all;
  for (const ScanBlocks& part : parts) all.join(part);
  const std::int64_t points = all.points;
  UpdateResult update = map.apply(std::move(all).updates());
  return {points, update.newly_known, update.updated_voxels, std::move(update.changed)};
}

}  // namespace canopeer
