#include "canopeer/bounds/limits/visit_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr double kCostStep = 0.05;  // s

/// A column on its way: with its fruits as a set too.
struct WayIn {
  double cost_s = std::numeric_limits<double>::infinity();
  double copies = 1.0;
  FruitSet any;
  std::vector<float> share;
};

/// The ways to view `v`, cheapest first, each with something that no cheaper one brings.
void add_ways_to(std::size_t v, const std::vector<PoolView>& views,
                 const std::vector<ViewFruits>& seen, double look_s, const MotionBound& motion,
                 std::vector<WayIn>& offers) {
  const std::size_t fruits = seen[v].share.size();
  std::vector<WayIn> steps;
  for (std::size_t u = 0; u < views.size(); ++u) {
    if (u == v || seen[v].any.within(seen[u].found)) continue;
    const double cost_s = look_s + motion.between(views[u].q, views[v].q);
    const auto step = static_cast<std::size_t>(cost_s / kCostStep);
    while (steps.size() <= step) steps.push_back({.any = FruitSet(fruits), .share = {}});
    steps[step].cost_s = std::min(steps[step].cost_s, cost_s);
    steps[step].any.add_difference(seen[v].any, seen[u].found);
  }
  const auto first = static_cast<std::ptrdiff_t>(offers.size());
  for (WayIn& offer : steps) {
    const bool old = std::any_of(offers.begin() + first, offers.end(), [&](const WayIn& cheaper) {
      return offer.any.within(cheaper.any);
    });
    if (old) continue;  // nothing is within anything
    offer.share = seen[v].share;
    for (std::size_t f = 0; f < fruits; ++f) offer.share[f] *= offer.any.has(f) ? 1.0F : 0.0F;
    offers.push_back(std::move(offer));
  }
}

bool offers_no_more(const WayIn& a, const WayIn& b) {
  if (!a.any.within(b.any)) return false;
  for (std::size_t f = 0; f < a.share.size(); ++f) {
    if (a.share[f] > b.share[f]) return false;
  }
  return true;
}

/// Cheapest first; of equal cost those with more fruits.
std::vector<WayIn> not_dominated(std::vector<WayIn> offers) {
  std::stable_sort(offers.begin(), offers.end(), [](const WayIn& a, const WayIn& b) {
    if (a.cost_s != b.cost_s) return a.cost_s < b.cost_s;
    return a.any.size() > b.any.size();
  });
  std::vector<WayIn> kept;
  for (WayIn& offer : offers) {
    const auto better = std::find_if(
        kept.begin(), kept.end(), [&](const WayIn& other) { return offers_no_more(offer, other); });
    if (better == kept.end()) {
      kept.push_back(std::move(offer));
    } else {
      better->copies += offer.copies;
    }
  }
  return kept;
}

void merge(WayIn& into, const WayIn& offer) {
  into.cost_s = std::min(into.cost_s, offer.cost_s);
  into.copies += offer.copies;
  into.any.add(offer.any);
  for (std::size_t f = 0; f < into.share.size(); ++f) {
    into.share[f] = std::max(into.share[f], offer.share[f]);
  }
}

/// Each joins the first that it changes by no more than `slack`: in fruits, and in cost.
std::vector<WayIn> merged(const std::vector<WayIn>& offers, double slack) {
  std::vector<WayIn> leaders;
  for (const WayIn& offer : offers) {
    const auto leader = std::find_if(leaders.begin(), leaders.end(), [&](const WayIn& other) {
      return other.any.lacks(offer.any) <= slack * other.any.size() &&
             other.cost_s - offer.cost_s <= slack * other.cost_s;
    });
    if (leader == leaders.end()) {
      leaders.push_back(offer);
    } else {
      merge(*leader, offer);
    }
  }
  return leaders;
}

std::vector<WayIn> at_most(std::vector<WayIn> offers, std::size_t most) {
  if (offers.size() <= most) return offers;
  // Who has most fruits leads: others change it least.
  std::stable_sort(offers.begin(), offers.end(),
                   [](const WayIn& a, const WayIn& b) { return a.any.size() > b.any.size(); });
  for (double slack = 0.02;; slack *= 1.4) {
    std::vector<WayIn> fewer = merged(offers, slack);
    // With more slack than there are fruits all are one.
    if (fewer.size() <= most) return not_dominated(std::move(fewer));
  }
}

}  // namespace

SegmentColumns segment_columns(const FruitPatches& patches, const PoolFruits& fruits,
                               const std::vector<PoolView>& views, double look_s,
                               const MotionBound& motion, int most) {
  CANOPEER_CHECK(!views.empty(), "a segment's first view is that at home");
  CANOPEER_CHECK(most >= 1, "at least one column a segment");
  std::vector<ViewFruits> seen;
  seen.reserve(views.size());
  for (const PoolView& view : views) seen.push_back(fruits.seen_by(patches, view));

  std::vector<WayIn> offers;
  for (std::size_t v = 1; v < views.size(); ++v) {
    add_ways_to(v, views, seen, look_s, motion, offers);
  }
  offers = at_most(not_dominated(std::move(offers)), static_cast<std::size_t>(most));

  SegmentColumns segment{std::move(seen.front()), {}, 0.0};
  for (const WayIn& offer : offers) {
    VisitColumn column{offer.cost_s, offer.copies, {}};
    for (std::size_t f = 0; f < offer.share.size(); ++f) {
      if (offer.share[f] > 0.0F) column.shares.emplace_back(static_cast<int>(f), offer.share[f]);
    }
    segment.dearest_s = std::max(segment.dearest_s, offer.cost_s);
    segment.columns.push_back(std::move(column));
  }
  return segment;
}

}  // namespace canopeer
