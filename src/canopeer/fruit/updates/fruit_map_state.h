#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "canopeer/fruit/confidence/plausibility.h"
#include "canopeer/fruit/fruit_map.h"

// The inside of FruitMap, for its own files: fruit_map.cpp (an update from beginning to end),
// fruit_patches.cpp (which surface is looked at), fruit_measures.cpp (what is found there),
// fruit_map_state.cpp (all of it as bytes).

namespace canopeer {

/// A fruit with all that the next update wants to know of it.
struct KnownFruit {
  FruitEstimate estimate;
  FruitEvidence evidence;
  SurfaceEvidence seen;
  SuperellipsoidFit fit;
  std::vector<std::uint64_t> cells;   ///< its surface, ascending
  std::vector<int> blocks;            ///< its cells lie in, ascending
  std::vector<SurfacePoint> surface;  ///< until its shape is fitted

  /// `surface` is only there during an update.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(estimate, evidence, seen, fit, cells, blocks);
  }
};

/// Surface of the blocks that hang together, and which block each point comes from.
struct Patch {
  std::vector<int> blocks;            ///< ascending
  bool known = false;                 ///< some of it belongs to a fruit already
  int since = 0;                      ///< the update its oldest change waits since
  int points = 0;                     ///< of fruit surface
  std::vector<SurfacePoint> surface;  ///< once the patch is taken
  std::vector<const SurfaceVertex*> vertex;
  std::vector<int> block;
};

/// A frame and where it saw fruit.
struct Sight {
  double time_s = 0.0;
  std::vector<int> blocks;  ///< ascending
  int update = 0;           ///< the first one after it

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(time_s, blocks, update);
  }
};

/// Both ascending.
[[nodiscard]] bool share_element(const std::vector<int>& a, const std::vector<int>& b);

template <typename T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

struct FruitMap::State {
  explicit State(const FruitMapOptions& o) : options(o), surface(o.tsdf), tracker(o.id_distance_m) {
    fit_options.prior = o.prior;
    fit_options.max_points = o.fit_points;
    again_options = fit_options;
    again_options.max_points = std::min(o.fit_points, o.refit_points);
  }

  FruitMapOptions options;
  FitOptions fit_options;
  FitOptions again_options;  // of shapes that are known already
  FruitSurface surface;
  FruitTracker tracker;
  std::vector<KnownFruit> known;          // by ascending id
  std::vector<FruitEstimate> fruits;      // of these the likely ones, as handed out
  std::vector<FruitEstimate> candidates;  // all
  std::vector<IdChange> id_changes;
  int fits = 0;
  // Frames since the last update, and before it while what they saw may still be waiting.
  std::vector<Sight> sights;
  std::vector<int> fruit_points;  // by block: how much of its surface counts
  int updates = 0;
  static constexpr int kNotWaiting = -1;
  std::vector<int> waits_since;  // by block: the update its oldest change was there for

  /// What later calls depend on; rebuild() tells the rest from it.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(surface, tracker, known, id_changes, fits, sights, updates, waits_since);
  }
  [[nodiscard]] bool rebuild();

  [[nodiscard]] bool counts(const SurfaceVertex& v) const {
    return v.fruit_share >= options.min_fruit_share;
  }
  void count_points(int block);
  std::vector<int> update_surface(int max_blocks);
  [[nodiscard]] std::vector<Patch> patches_around(const std::vector<int>& changed) const;
  void collect_surface(Patch& patch) const;
  void drop_odd_pieces(Patch& patch) const;
  void solve(const Patch& patch, std::vector<KnownFruit>& found) const;
  [[nodiscard]] double foreign_share(const ShapeEstimate& shape, const KnownFruit& fruit) const;
  [[nodiscard]] double free_share(const std::vector<SurfacePoint>& shape) const;
  void measure(KnownFruit& fruit, const KnownFruit* before, const std::vector<int>& changed,
               bool anew);
  std::vector<Patch> take_patches(const std::vector<int>& changed, bool all,
                                  std::vector<int>& concerned);
  void update(const std::vector<int>& new_changes, bool all);
  void count_views();
  void judge();
  void hand_out();
};

}  // namespace canopeer
