#include "canopeer/viewgraph/target_sampler.h"

#include <algorithm>
#include <array>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

TargetSampler::TargetSampler(const FrontierTargets& targets, double resolution_m,
                             const TargetShares& shares, const Weight& weight)
    : resolution_m_(resolution_m), shares_(shares) {
  auto kinds = std::make_shared<Kinds>();
  const auto weigh = [&](TargetKind kind, const std::vector<VoxelIndex>& voxels) {
    Weighted& weighted = (*kinds)[static_cast<std::size_t>(kind)];
    double sum = 0.0;
    for (const VoxelIndex& voxel : voxels) {
      const double w = weight ? weight(voxel_centre(voxel, resolution_m)) : 1.0;
      if (w <= 0.0) continue;
      weighted.voxels.push_back(voxel);
      weighted.until.push_back(sum += w);
    }
  };
  weigh(TargetKind::roi, targets.roi);
  weigh(TargetKind::occupied, targets.occupied);
  weigh(TargetKind::border, targets.border);
  kinds_ = std::move(kinds);
}

void TargetSampler::close(TargetKind kind, bool closed) {
  closed_[static_cast<std::size_t>(kind)] = closed;
}

bool TargetSampler::empty() const {
  return !available(TargetKind::roi) && !available(TargetKind::occupied) &&
         !available(TargetKind::border);
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
  CANOPEER_CHECK(available(kind), "an open kind with targets");
  const auto& [voxels, until] = of_kind(kind);
  const auto it = std::upper_bound(until.begin(), until.end(), rng.uniform() * until.back());
  const auto i = std::min<std::ptrdiff_t>(it - until.begin(), std::ssize(until) - 1);
  return {kind, voxel_centre(voxels[static_cast<std::size_t>(i)], resolution_m_)};
}

}  // namespace canopeer
