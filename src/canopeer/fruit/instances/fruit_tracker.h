#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// A fruit as a tracker sees it.
struct TrackedFruit {
  int id = -1;
  Vec3 centre = Vec3::Zero();
  std::vector<std::uint64_t> cells;  ///< keys of its surface cells, ascending

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(id, centre, cells);
  }
};

/// What happened to an id.
struct IdChange {
  enum class Kind { merged, split } kind = Kind::merged;
  int id = 0;     ///< the fruit that ended (merged) or began (split)
  int other = 0;  ///< the fruit it went into, or came out of

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(kind, id, other);
  }
};

/// Gives out ids 0, 1, 2, … such that a fruit found again keeps its own. Fruits are the same when
/// they share surface; where they share none, when their centres are close.
class FruitTracker {
 public:
  explicit FruitTracker(double max_distance_m) : max_distance_m_(max_distance_m) {}

  /// Sets the ids of `found`, which come in place of `before`. The fruit that shares most surface
  /// takes the id. Two fruits of before that are one now merge into it. Of one that is two now, the
  /// larger part keeps the id. What is new may take the id of a fruit that got lost near it.
  void assign(std::vector<TrackedFruit>& found, const std::vector<TrackedFruit>& before);

  /// Merges and splits of the last assign().
  [[nodiscard]] const std::vector<IdChange>& changes() const { return changes_; }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(lost_, changes_, next_);
  }

 private:
  double max_distance_m_;
  std::vector<TrackedFruit> lost_;
  std::vector<IdChange> changes_;
  int next_ = 0;
};

}  // namespace canopeer
