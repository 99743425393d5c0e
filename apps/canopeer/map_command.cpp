#include <cstdio>
#include <system_error>

#include "canopeer/map/map_file.h"
#include "commands.h"
#include "exit_status.h"
#include "map_summary.h"

namespace canopeer::app {
namespace {

// The number of voxels with ROI log-odds, ROI or not.
std::int64_t looked_at(const VoxelMap& map, BlockKey key) {
  std::int64_t count = 0;
  for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& voxel) {
    count += map.roi_log_odds(voxel) != 0.0 || map.is_roi(voxel);
  });
  return count;
}

void print_bounds(const char* what, const Box& box) {
  if (box.isEmpty()) return;
  std::printf("%-18sx %.3f … %.3f m, y %.3f … %.3f m, z %.3f … %.3f m\n", what, box.min().x(),
              box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z());
}

}  // namespace

void print_map(const VoxelMap& map) {
  Box known, occupied, roi;
  std::int64_t roi_known = 0;
  const auto extend = [&](Box& box, BlockKey key, const VoxelMask& mask) {
    for_each_voxel(key, mask, [&](const VoxelIndex& voxel) {
      box.extend(Vec3(voxel.cast<double>() * map.resolution_m()));
      box.extend(Vec3((voxel.cast<double>().array() + 1.0).matrix() * map.resolution_m()));
    });
  };
  const std::vector<BlockKey> keys = map.block_keys();
  for (const BlockKey key : keys) {
    const BlockMasks& masks = *map.block(key);
    extend(known, key, masks.observed);
    extend(occupied, key, masks.occupied);
    extend(roi, key, masks.roi);
    roi_known += looked_at(map, key);
  }
  const auto count = [](std::int64_t n) { return static_cast<long long>(n); };
  const double r = map.resolution_m();
  std::printf("resolution        %g m\n", r);
  std::printf("known voxels      %lld (%.4g m³): %lld occupied, %lld free\n",
              count(map.observed_voxels()), static_cast<double>(map.observed_voxels()) * r * r * r,
              count(map.occupied_voxels()), count(map.observed_voxels() - map.occupied_voxels()));
  std::printf("ROI voxels        %lld (of %lld looked at)\n", count(map.roi_voxels()),
              count(roi_known));
  std::printf("blocks            %zu of 8 × 8 × 8 voxels\n", keys.size());
  print_bounds("known space", known);
  print_bounds("occupied space", occupied);
  print_bounds("ROI space", roi);
  std::printf("memory            %.1f MB\n", static_cast<double>(map.memory_bytes()) / 1e6);
}

void map_info(const std::string& path) {
  const MapFile file = value_or_stop(read_map(path), kBadInput);
  for (const auto& part : file.files) {
    std::error_code code;
    const auto bytes = std::filesystem::file_size(part, code);
    std::printf("file              %s (%.1f kB)\n", part.c_str(),
                static_cast<double>(code ? 0 : bytes) / 1e3);
  }
  std::printf("format            %s\n", file.format.c_str());
  print_map(file.map);
}

void map_convert(const std::string& in, const std::string& out) {
  value_or_stop(check_map_destination(out), kBadInput);
  const MapFile file = value_or_stop(read_map(in), kBadInput);
  for (const auto& written : value_or_stop(write_map(file.map, out), kFailed)) {
    std::printf("%s\n", written.c_str());
  }
}

}  // namespace canopeer::app
