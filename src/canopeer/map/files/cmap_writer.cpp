#include <tbb/parallel_for.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"
#include "canopeer/base/check.h"
#include "canopeer/map/cmap_file.h"
#include "canopeer/map/files/cmap_format.h"

namespace canopeer {

namespace cmap_format {

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace cmap_format

namespace {

using namespace cmap_format;

constexpr int kCompressionLevel = 3;

void append_mask(std::string& bytes, const VoxelMask& mask) {
  for (const std::uint64_t slice : mask.slices) append_number(bytes, slice);
}

void append_log_odds(std::string& bytes, double log_odds) {
  const double steps = log_odds / kLogOddsUnit;
  const auto value = static_cast<std::int16_t>(std::lround(steps));
  CANOPEER_CHECK(value == steps, "log-odds must be multiples of the file's unit");
  append_number(bytes, value);
}

// The voxels that have ROI log-odds: any but 0, or 0 that makes a ROI by a low threshold.
VoxelMask roi_known(const VoxelMap& map, BlockKey key) {
  VoxelMask known = map.block(key)->roi;
  for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& voxel) {
    if (map.roi_log_odds(voxel) != 0.0) known.set(voxel);
  });
  return known;
}

// Masks first, then values: alike beside alike compresses best.
std::string content_of(const VoxelMap& map, std::span<const BlockKey> keys) {
  std::vector<VoxelMask> roi;
  roi.reserve(keys.size());
  for (const BlockKey key : keys) roi.push_back(roi_known(map, key));
  std::string bytes;
  for (const BlockKey key : keys) append_mask(bytes, map.block(key)->observed);
  for (const VoxelMask& mask : roi) append_mask(bytes, mask);
  for (const BlockKey key : keys) {
    for_each_voxel(key, map.block(key)->observed, [&](const VoxelIndex& voxel) {
      append_log_odds(bytes, map.occupancy_log_odds(voxel));
    });
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for_each_voxel(keys[i], roi[i], [&](const VoxelIndex& voxel) {
      append_log_odds(bytes, map.roi_log_odds(voxel));
    });
  }
  return bytes;
}

std::string compress(const std::string& content) {
  std::string bytes(ZSTD_compressBound(content.size()), '\0');
  const std::size_t size =
      ZSTD_compress(bytes.data(), bytes.size(), content.data(), content.size(), kCompressionLevel);
  CANOPEER_CHECK(ZSTD_isError(size) == 0, "compressing into a large enough buffer");
  bytes.resize(size);
  return bytes;
}

std::string group_of(const VoxelMap& map, std::span<const BlockKey> keys) {
  const std::string compressed = compress(content_of(map, keys));
  std::string bytes;
  bytes.reserve(kGroupFrameBytes + keys.size_bytes() + compressed.size());
  append_number(bytes, static_cast<std::uint32_t>(keys.size()));
  append_number(bytes, static_cast<std::uint32_t>(compressed.size()));
  for (const BlockKey key : keys) append_number(bytes, key);
  bytes += compressed;
  append_number(bytes, checksum(bytes));
  return bytes;
}

std::string header_of(const VoxelMap& map, std::size_t blocks) {
  const VoxelMapOptions& options = map.options();
  std::string bytes(kMagic);
  append_number(bytes, kVersion);
  for (const double option :
       {options.resolution_m, options.hit_probability, options.miss_probability, options.clamp_min,
        options.clamp_max, options.occupied_threshold, kLogOddsUnit}) {
    append_number(bytes, option);
  }
  append_number(bytes, static_cast<std::uint64_t>(blocks));
  for (const std::int64_t count :
       {map.observed_voxels(), map.occupied_voxels(), map.roi_voxels()}) {
    append_number(bytes, count);
  }
  append_number(bytes, checksum(bytes));
  return bytes;
}

}  // namespace

std::string cmap_bytes(const VoxelMap& map) {
  const std::vector<BlockKey> keys = map.block_keys();
  std::vector<std::string> groups((keys.size() + kGroupBlocks - 1) / kGroupBlocks);
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t i) {
    const std::size_t first = i * kGroupBlocks;
    const std::size_t count = std::min(kGroupBlocks, keys.size() - first);
    groups[i] = group_of(map, std::span(keys).subspan(first, count));
  });
  std::string bytes = header_of(map, keys.size());
  std::size_t size = bytes.size();
  for (const std::string& group : groups) size += group.size();
  bytes.reserve(size);
  for (std::string& group : groups) {
    bytes += group;
    group = {};
  }
  return bytes;
}

Expected<void> write_cmap(const VoxelMap& map, const std::filesystem::path& path) {
  return write_file(path, cmap_bytes(map));
}

}  // namespace canopeer
