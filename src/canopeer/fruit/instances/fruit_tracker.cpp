#include "canopeer/fruit/instances/fruit_tracker.h"

#include <algorithm>
#include <tuple>

namespace canopeer {
namespace {

constexpr double kFar_m = 0.15;  // fruits farther apart share no surface

int common_cells(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  int common = 0;
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (*i < *j) {
      ++i;
    } else if (*j < *i) {
      ++j;
    } else {
      ++common;
      ++i;
      ++j;
    }
  }
  return common;
}

struct Link {
  int common = 0;
  double distance_m = 0.0;
  int found = 0;
  int before = 0;
};

/// Most shared surface first; then the closest centres.
bool stronger(const Link& a, const Link& b) {
  return std::make_tuple(-a.common, a.distance_m, a.found, a.before) <
         std::make_tuple(-b.common, b.distance_m, b.found, b.before);
}

std::vector<Link> links_between(const std::vector<TrackedFruit>& found,
                                const std::vector<TrackedFruit>& before) {
  std::vector<Link> links;
  for (std::size_t f = 0; f < found.size(); ++f) {
    for (std::size_t b = 0; b < before.size(); ++b) {
      const double distance = (found[f].centre - before[b].centre).norm();
      if (distance > kFar_m) continue;
      links.push_back({common_cells(found[f].cells, before[b].cells), distance, static_cast<int>(f),
                       static_cast<int>(b)});
    }
  }
  std::sort(links.begin(), links.end(), stronger);
  return links;
}

}  // namespace

void FruitTracker::assign(std::vector<TrackedFruit>& found,
                          const std::vector<TrackedFruit>& before) {
  changes_.clear();
  std::vector<TrackedFruit> old = before;
  old.insert(old.end(), lost_.begin(), lost_.end());
  for (TrackedFruit& fruit : found) fruit.id = -1;
  std::vector<char> taken(old.size(), 0);
  const std::vector<Link> links = links_between(found, old);
  for (const Link& link : links) {
    if (link.common == 0 && link.distance_m > max_distance_m_) continue;
    if (found[link.found].id >= 0 || taken[link.before] != 0) continue;
    found[link.found].id = old[link.before].id;
    taken[link.before] = 1;
  }
  for (TrackedFruit& fruit : found) {
    if (fruit.id < 0) fruit.id = next_++;
  }
  // What shares most of its surface with a fruit of another id went into it, or came out of it.
  for (const Link& link : links) {
    const TrackedFruit& f = found[link.found];
    const TrackedFruit& b = old[link.before];
    if (f.id == b.id) continue;
    const auto most_of = [&](const TrackedFruit& x) {
      return 2 * link.common > static_cast<int>(x.cells.size());
    };
    if (taken[link.before] == 0 && most_of(b)) {
      changes_.push_back({IdChange::Kind::merged, b.id, f.id});
      taken[link.before] = 2;  // it lives on in the other: not lost
    } else if (taken[link.before] == 1 && most_of(f)) {
      changes_.push_back({IdChange::Kind::split, f.id, b.id});
    }
  }
  lost_.clear();
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (taken[i] == 0) lost_.push_back(std::move(old[i]));
  }
}

}  // namespace canopeer
