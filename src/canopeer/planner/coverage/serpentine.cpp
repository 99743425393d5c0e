#include "canopeer/planner/coverage/serpentine.h"

#include <algorithm>
#include <cmath>

#include "canopeer/planner/coverage/row_ahead.h"

namespace canopeer {
namespace {

/// Evenly spaced from low to high, both included.
std::vector<double> steps(double low, double high, double spacing) {
  const int gaps = std::max(1, static_cast<int>(std::ceil((high - low) / spacing - 1e-9)));
  std::vector<double> values;
  for (int i = 0; i <= gaps; ++i) values.push_back(low + (high - low) * i / gaps);
  return values;
}

}  // namespace

std::vector<FixedView> serpentine(const Box& workspace_base, const Box& sampling_region_base,
                                  const SerpentineOptions& options) {
  const RowAhead row = row_ahead(workspace_base, sampling_region_base, options.row_distance_m);
  std::vector<Vec3> positions;
  const auto heights = steps(workspace_base.min().z(), workspace_base.max().z(), options.spacing_m);
  auto line =
      steps(workspace_base.min()[row.along], workspace_base.max()[row.along], options.spacing_m);
  for (auto z = heights.rbegin(); z != heights.rend(); ++z) {
    for (const double at : line) {
      Vec3 p;
      p[row.depth] = row.plane_m;
      p[row.along] = at;
      p.z() = *z;
      positions.push_back(p);
    }
    std::reverse(line.begin(), line.end());
  }
  std::vector<FixedView> views;
  for (const Vec3& direction : scan_directions(row, options.tilt_rad)) {
    for (const Vec3& p : positions) views.push_back({p, p + options.look_distance_m * direction});
    std::reverse(positions.begin(), positions.end());
  }
  return views;
}

std::vector<FixedView> serpentine(const SegmentFrame& segment, const SerpentineOptions& options) {
  return serpentine(segment.workspace_base, sampling_region_base(segment), options);
}

}  // namespace canopeer
