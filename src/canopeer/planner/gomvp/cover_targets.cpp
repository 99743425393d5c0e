#include "canopeer/planner/gomvp/cover_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

using GridCell = std::tuple<int, int, int>;

/// The first voxel of each cell that holds none yet.
std::vector<CoverTarget> thinned(const std::vector<VoxelIndex>& voxels, TargetKind kind,
                                 double cells_per_voxel, std::set<GridCell>& taken) {
  std::vector<CoverTarget> targets;
  const auto cell = [&](int i) {
    return static_cast<int>(std::floor((i + 0.5) * cells_per_voxel));
  };
  for (const VoxelIndex& voxel : voxels) {
    if (!taken.emplace(cell(voxel.x()), cell(voxel.y()), cell(voxel.z())).second) continue;
    targets.push_back({voxel, kind});
  }
  return targets;
}

/// How many of each kind are taken.
std::array<std::size_t, 3> quotas(const std::array<std::size_t, 3>& there,
                                  const std::array<double, 3>& shares, std::size_t most) {
  std::array<std::size_t, 3> quota{};
  std::size_t left = most;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const auto share = static_cast<std::size_t>(shares[kind] * static_cast<double>(most));
    quota[kind] = std::min({share, there[kind], left});
    left -= quota[kind];
  }
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const std::size_t more = std::min(left, there[kind] - quota[kind]);
    quota[kind] += more;
    left -= more;
  }
  return quota;
}

}  // namespace

std::vector<CoverTarget> choose_targets(const FrontierTargets& frontiers, double resolution_m,
                                        const GomvpOptions& options) {
  const double cells_per_voxel = resolution_m / options.target_grid_m;
  std::set<GridCell> taken;
  const std::array kinds = {
      thinned(frontiers.roi, TargetKind::roi, cells_per_voxel, taken),
      thinned(frontiers.occupied, TargetKind::occupied, cells_per_voxel, taken),
      thinned(frontiers.border, TargetKind::border, cells_per_voxel, taken)};
  const auto quota = quotas({kinds[0].size(), kinds[1].size(), kinds[2].size()},
                            {options.shares.roi, options.shares.occupied, options.shares.border},
                            static_cast<std::size_t>(options.max_targets));
  std::vector<CoverTarget> targets;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    for (std::size_t i = 0; i < quota[kind]; ++i) {
      targets.push_back(kinds[kind][i * kinds[kind].size() / quota[kind]]);
    }
  }
  return targets;
}

bool is_seen(const VoxelMap& map, const CoverTarget& target) {
  const bool edges_too = target.kind == TargetKind::roi;  // 18 neighbours, else 6
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const int off_axis = std::abs(dx) + std::abs(dy) + std::abs(dz);
        if (off_axis == 0 || off_axis > (edges_too ? 2 : 1)) continue;
        if (map.occupancy(target.voxel + VoxelIndex(dx, dy, dz)) == Occupancy::unknown)
          return false;
      }
    }
  }
  return true;
}

}  // namespace canopeer
