#include "canopeer/record/yardstick_shares.h"

namespace canopeer {
namespace {

using Figure = std::optional<double>;

Figure as_figure(const std::optional<int>& count) { return count ? Figure(*count) : std::nullopt; }

Figure share_of(const Figure& result, const Figure& most) {
  if (!result || !most || !(*most > 0.0)) return std::nullopt;
  return *result / *most;
}

Figure gap_to(const Figure& bound, const Figure& result) {
  if (!result || !bound || !(*bound > 0.0)) return std::nullopt;
  return (*bound - *result) / *bound;
}

Figure found_of(const std::optional<BestResult>& best) {
  return best ? Figure(best->detected) : std::nullopt;
}
Figure auc_of(const std::optional<BestResult>& best) {
  return best ? Figure(best->auc) : std::nullopt;
}
Figure fruits_of(const std::optional<UpperBound>& bound) {
  return bound ? bound->fruits : std::nullopt;
}
Figure auc_of(const std::optional<UpperBound>& bound) { return bound ? bound->auc : std::nullopt; }

}  // namespace

void hold_against(const Yardstick& y, RunScores& s) {
  const Figure found = as_figure(s.detected);
  s.ceiling_fruits_share = share_of(found, as_figure(y.ceiling_fruits));
  s.ceiling_surface_share = share_of(s.roi_surface_coverage, y.ceiling_surface);
  s.clairvoyant_found_share = share_of(found, found_of(y.clairvoyant));
  s.clairvoyant_auc_share = share_of(s.auc, auc_of(y.clairvoyant));
  s.best_found_share = share_of(found, found_of(y.best_found));
  s.best_auc_share = share_of(s.auc, auc_of(y.best_auc));
  s.sampled_found_gap = gap_to(fruits_of(y.sampled), found);
  s.sampled_auc_gap = gap_to(auc_of(y.sampled), s.auc);
  s.certified_found_gap = gap_to(fruits_of(y.certified), found);
  s.certified_auc_gap = gap_to(auc_of(y.certified), s.auc);
}

Expected<void> check_fits(const Yardstick& y, const std::string& mission,
                          const std::string& protocol,
                          const std::optional<std::uint64_t>& world_seed,
                          const std::optional<int>& fruits_total) {
  const std::string rules = protocol.empty() ? kOwnProtocol : protocol;
  if (y.mission != mission) {
    return fail("is of mission '" + y.mission + "', the run is of '" + mission + "'");
  }
  if (y.protocol != rules) {
    return fail("is of protocol '" + y.protocol + "', the run is of '" + rules + "'");
  }
  if (world_seed && y.world_seed != *world_seed) {
    return fail("is of the world of seed " + std::to_string(y.world_seed) +
                ", the run is of seed " + std::to_string(*world_seed));
  }
  if (fruits_total && y.fruits_total != *fruits_total) {
    return fail("is of a world with " + std::to_string(y.fruits_total) +
                " fruits that count, the run's has " + std::to_string(*fruits_total));
  }
  return {};
}

}  // namespace canopeer
