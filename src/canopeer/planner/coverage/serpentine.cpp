#include "canopeer/planner/coverage/serpentine.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

/// Evenly spaced from low to high, both included.
std::vector<double> steps(double low, double high, double spacing) {
  const int gaps = std::max(1, static_cast<int>(std::ceil((high - low) / spacing - 1e-9)));
  std::vector<double> values;
  for (int i = 0; i <= gaps; ++i) values.push_back(low + (high - low) * i / gaps);
  return values;
}

/// Unit vectors of the passes: straight at the row, then tilted left, right, up, down.
std::vector<Vec3> directions(const Vec3& forward, double tilt) {
  const Vec3 up = Vec3::UnitZ();
  const Vec3 side = forward.cross(up);
  std::vector<Vec3> all = {forward};
  for (const Vec3& aside : {Vec3(-side), side, up, Vec3(-up)}) {
    all.push_back(std::cos(tilt) * forward + std::sin(tilt) * aside);
  }
  return all;
}

}  // namespace

std::vector<FixedView> serpentine(const Box& workspace_base, const Box& sampling_region_base,
                                  const SerpentineOptions& options) {
  const Vec3 apart = sampling_region_base.center() - workspace_base.center();
  const int depth = std::abs(apart.x()) > std::abs(apart.y()) ? 0 : 1;
  const int along = 1 - depth;
  Vec3 forward = Vec3::Zero();
  forward[depth] = apart[depth] > 0.0 ? 1.0 : -1.0;
  const double plane =
      std::clamp(sampling_region_base.center()[depth] - forward[depth] * options.row_distance_m,
                 workspace_base.min()[depth], workspace_base.max()[depth]);

  std::vector<Vec3> positions;
  const auto heights = steps(workspace_base.min().z(), workspace_base.max().z(), options.spacing_m);
  auto line = steps(workspace_base.min()[along], workspace_base.max()[along], options.spacing_m);
  for (auto z = heights.rbegin(); z != heights.rend(); ++z) {
    for (const double at : line) {
      Vec3 p;
      p[depth] = plane;
      p[along] = at;
      p.z() = *z;
      positions.push_back(p);
    }
    std::reverse(line.begin(), line.end());
  }
  std::vector<FixedView> views;
  for (const Vec3& direction : directions(forward, options.tilt_rad)) {
    for (const Vec3& p : positions) views.push_back({p, p + options.look_distance_m * direction});
    std::reverse(positions.begin(), positions.end());
  }
  return views;
}

}  // namespace canopeer
