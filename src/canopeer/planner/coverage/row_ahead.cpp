#include "canopeer/planner/coverage/row_ahead.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

RowAhead row_ahead(const Box& workspace_base, const Box& sampling_region_base,
                   double row_distance_m) {
  const Vec3 apart = sampling_region_base.center() - workspace_base.center();
  RowAhead row;
  row.depth = std::abs(apart.x()) > std::abs(apart.y()) ? 0 : 1;
  row.along = 1 - row.depth;
  row.forward = Vec3::Zero();
  row.forward[row.depth] = apart[row.depth] > 0.0 ? 1.0 : -1.0;
  row.plane_m =
      std::clamp(sampling_region_base.center()[row.depth] - row.forward[row.depth] * row_distance_m,
                 workspace_base.min()[row.depth], workspace_base.max()[row.depth]);
  return row;
}

std::vector<Vec3> scan_directions(const RowAhead& row, double tilt_rad) {
  const Vec3 up = Vec3::UnitZ();
  const Vec3 side = row.forward.cross(up);
  std::vector<Vec3> all = {row.forward};
  for (const Vec3& aside : {Vec3(-side), side, up, Vec3(-up)}) {
    all.push_back(std::cos(tilt_rad) * row.forward + std::sin(tilt_rad) * aside);
  }
  return all;
}

Box sampling_region_base(const SegmentFrame& segment) {
  return transformed(segment.sampling_region_world, segment.T_world_base.inverse());
}

}  // namespace canopeer
