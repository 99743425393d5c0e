#include "canopeer/viewgraph/target_sampler.h"

#include <array>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

TargetSampler::TargetSampler(FrontierTargets targets, double resolution_m,
                             const TargetShares& shares)
    : targets_(std::make_shared<const FrontierTargets>(std::move(targets))),
      resolution_m_(resolution_m),
      shares_(shares) {}

void TargetSampler::close(TargetKind kind, bool closed) {
  closed_[static_cast<std::size_t>(kind)] = closed;
}

bool TargetSampler::empty() const {
  return !available(TargetKind::roi) && !available(TargetKind::occupied) &&
         !available(TargetKind::border);
}

const std::vector<VoxelIndex>& TargetSampler::of_kind(TargetKind kind) const {
  CANOPEER_CHECK(kind != TargetKind::none, "a kind of frontier");
  if (kind == TargetKind::roi) return targets_->roi;
  return kind == TargetKind::occupied ? targets_->occupied : targets_->border;
}

std::optional<TargetKind> TargetSampler::draw_kind(Rng& rng) const {
  if (empty()) return std::nullopt;
  constexpr std::array kKinds = {TargetKind::roi, TargetKind::occupied, TargetKind::border};
  const double share = rng.uniform();
  std::size_t i = share < shares_.roi ? 0 : share < shares_.roi + shares_.occupied ? 1 : 2;
  while (!available(kKinds[i])) i = (i + 1) % kKinds.size();
  return kKinds[i];
}

Target TargetSampler::draw(TargetKind kind, Rng& rng) const {
  const auto& voxels = of_kind(kind);
  return {kind, voxel_centre(voxels[rng.index(voxels.size())], resolution_m_)};
}

}  // namespace canopeer
