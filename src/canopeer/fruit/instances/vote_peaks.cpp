#include "canopeer/fruit/instances/vote_peaks.h"

#include <algorithm>

#include "canopeer/fruit/surface/voxel_key.h"

namespace canopeer {
namespace {

constexpr double kBin_m = 0.01;
constexpr double kBandwidth_m = 0.02;  // votes of one pepper spread by about ± 1 cm
constexpr int kShifts = 8;

struct Vote {
  Vec3 centre;
  std::uint64_t place = 0;  // of its bin, by x, then y, then z
  bool open = true;         // not yet near a peak
};

struct Bin {
  Vec3 mean = Vec3::Zero();
  std::vector<int> votes;
};

std::vector<Vote> votes_of(std::span<const SurfacePoint> surface, const ShapePrior& prior) {
  std::vector<Vote> votes;
  votes.reserve(surface.size());
  for (const SurfacePoint& s : surface) {
    const Vec3 centre = centre_vote(s, prior.radius_m, prior.half_length_m);
    votes.push_back({centre, voxel_key(voxel_at(centre, kBin_m))});
  }
  return votes;
}

/// Votes by bin, the fullest bin first; ties by the bin's place, so that order means nothing.
std::vector<Bin> fullest_bins(const std::vector<Vote>& votes) {
  std::vector<int> order(votes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return votes[a].place < votes[b].place; });
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || votes[order[i]].place != votes[order[i - 1]].place) bins.emplace_back();
    bins.back().votes.push_back(order[i]);
    bins.back().mean += votes[order[i]].centre;
  }
  for (Bin& bin : bins) bin.mean /= static_cast<double>(bin.votes.size());
  std::stable_sort(bins.begin(), bins.end(),
                   [](const Bin& a, const Bin& b) { return a.votes.size() > b.votes.size(); });
  return bins;
}

/// Mean shift with a flat kernel over the open votes; returns the peak and its votes' number.
std::pair<Vec3, int> climb(const std::vector<Vote>& votes, Vec3 peak) {
  int near = 0;
  for (int shift = 0; shift < kShifts; ++shift) {
    Vec3 sum = Vec3::Zero();
    near = 0;
    for (const Vote& vote : votes) {
      if (!vote.open || (vote.centre - peak).squaredNorm() > kBandwidth_m * kBandwidth_m) continue;
      sum += vote.centre;
      ++near;
    }
    if (near == 0) break;
    const Vec3 next = sum / near;
    const bool arrived = (next - peak).squaredNorm() < 1e-8;
    peak = next;
    if (arrived) break;
  }
  return {peak, near};
}

}  // namespace

std::vector<Vec3> vote_peaks(std::span<const SurfacePoint> surface, const ShapePrior& prior,
                             double min_distance_m, int min_votes) {
  std::vector<Vote> votes = votes_of(surface, prior);
  std::vector<Vec3> peaks;
  constexpr int kMinVotesInBin = 3;
  for (const Bin& bin : fullest_bins(votes)) {
    const auto open = std::count_if(bin.votes.begin(), bin.votes.end(),
                                    [&](int vote) { return votes[vote].open; });
    if (open < kMinVotesInBin) continue;
    const auto [peak, near] = climb(votes, bin.mean);
    if (near < min_votes) continue;
    const bool taken = std::any_of(peaks.begin(), peaks.end(), [&, p = peak](const Vec3& other) {
      return (other - p).norm() < min_distance_m;
    });
    if (!taken) peaks.push_back(peak);
    for (Vote& vote : votes) {
      if ((vote.centre - peak).norm() < min_distance_m) vote.open = false;
    }
  }
  return peaks;
}

}  // namespace canopeer
