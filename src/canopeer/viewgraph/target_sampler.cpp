#include "canopeer/viewgraph/target_sampler.h"

#include <array>
#include <utility>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

TargetSampler::TargetSampler(FrontierTargets targets, double resolution_m,
                             const TargetShares& shares)
    : targets_(std::move(targets)), resolution_m_(resolution_m), shares_(shares) {}

bool TargetSampler::empty() const {
  return targets_.roi.empty() && targets_.occupied.empty() && targets_.border.empty();
}

std::optional<Target> TargetSampler::draw(Rng& rng) const {
  if (empty()) return std::nullopt;
  const std::array kinds = {std::pair{TargetKind::roi, &targets_.roi},
                            std::pair{TargetKind::occupied, &targets_.occupied},
                            std::pair{TargetKind::border, &targets_.border}};
  const double share = rng.uniform();
  std::size_t kind = share < shares_.roi ? 0 : share < shares_.roi + shares_.occupied ? 1 : 2;
  while (kinds[kind].second->empty()) kind = (kind + 1) % kinds.size();
  const auto& voxels = *kinds[kind].second;
  return Target{kinds[kind].first, voxel_centre(voxels[rng.index(voxels.size())], resolution_m_)};
}

}  // namespace canopeer
