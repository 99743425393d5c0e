#include "canopeer/fruit/fruit_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "canopeer/base/check.h"
#include "canopeer/fruit/euclidean_clusters.h"
#include "canopeer/fruit/fruit_separation.h"
#include "canopeer/fruit/missing_surface.h"
#include "canopeer/fruit/piece_filter.h"
#include "canopeer/fruit/plausibility.h"
#include "canopeer/fruit/voxel_key.h"

namespace canopeer {
namespace {

/// A fruit with all that the next update wants to know of it.
struct KnownFruit {
  FruitEstimate estimate;
  FruitEvidence evidence;
  SurfaceEvidence seen;
  SuperellipsoidFit fit;
  std::vector<std::uint64_t> cells;   ///< its surface, ascending
  std::vector<int> blocks;            ///< its cells lie in, ascending
  std::vector<SurfacePoint> surface;  ///< until its shape is fitted
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
};

bool share_element(const std::vector<int>& a, const std::vector<int>& b) {
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (*i == *j) return true;
    if (*i < *j) {
      ++i;
    } else {
      ++j;
    }
  }
  return false;
}

template <typename T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

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

  [[nodiscard]] bool counts(const SurfaceVertex& v) const {
    return v.fruit_share >= options.min_fruit_share;
  }
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
  void hand_out();
};

/// The numbers of the blocks whose surface is another now.
std::vector<int> FruitMap::State::update_surface(int max_blocks) {
  std::vector<int> changed = surface.update(max_blocks);
  fruit_points.resize(surface.tsdf().blocks().size(), 0);
  for (const int block : changed) {
    const auto& vertices = surface.vertices(block);
    const auto count = std::count_if(vertices.begin(), vertices.end(),
                                     [&](const SurfaceVertex& v) { return counts(v); });
    fruit_points[block] = static_cast<int>(count);
  }
  return changed;
}

/// Blocks with fruit surface that touch, from the changed ones on; each patch once.
std::vector<Patch> FruitMap::State::patches_around(const std::vector<int>& changed) const {
  const FruitTsdf& tsdf = surface.tsdf();
  std::vector<char> reached(tsdf.blocks().size(), 0);
  const auto has_fruit = [&](int block) { return fruit_points[block] != 0; };
  // A changed block may have lost its surface; its neighbours then still want another look.
  std::vector<int> starts;
  for (const int block : changed) {
    for (const int other : tsdf.blocks()[static_cast<std::size_t>(block)]->around) {
      if (other >= 0 && has_fruit(other)) starts.push_back(other);
    }
  }
  sort_unique(starts);
  std::vector<Patch> patches;
  for (const int start : starts) {
    if (reached[start] != 0) continue;
    Patch& patch = patches.emplace_back();
    reached[start] = 1;
    patch.blocks.push_back(start);
    for (std::size_t next = 0; next < patch.blocks.size(); ++next) {
      for (const int other : tsdf.blocks()[static_cast<std::size_t>(patch.blocks[next])]->around) {
        if (other < 0 || reached[other] != 0 || !has_fruit(other)) continue;
        reached[other] = 1;
        patch.blocks.push_back(other);
      }
    }
    std::sort(patch.blocks.begin(), patch.blocks.end());
    for (const int block : patch.blocks) patch.points += fruit_points[block];
  }
  return patches;
}

void FruitMap::State::collect_surface(Patch& patch) const {
  const auto count = static_cast<std::size_t>(patch.points);
  patch.surface.reserve(count);
  patch.vertex.reserve(count);
  patch.block.reserve(count);
  for (const int block : patch.blocks) {
    for (const SurfaceVertex& vertex : surface.vertices(block)) {
      if (!counts(vertex)) continue;
      patch.surface.push_back(vertex.surface);
      patch.vertex.push_back(&vertex);
      patch.block.push_back(block);
    }
  }
}

/// Takes the points of pieces out that cannot be fruit.
void FruitMap::State::drop_odd_pieces(Patch& patch) const {
  const std::vector<int> piece = euclidean_clusters(patch.surface, options.cluster_tolerance_m);
  const std::vector<char> keep = ordinary_pieces(patch.surface, piece, options);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < patch.surface.size(); ++i) {
    if (keep[i] == 0) continue;
    patch.surface[kept] = patch.surface[i];
    patch.vertex[kept] = patch.vertex[i];
    patch.block[kept] = patch.block[i];
    ++kept;
  }
  patch.surface.resize(kept);
  patch.vertex.resize(kept);
  patch.block.resize(kept);
}

/// The patch's fruits with what can be said before their shapes are fitted.
void FruitMap::State::solve(const Patch& patch, std::vector<KnownFruit>& found) const {
  for (const SeparatedFruit& separated : separate_fruits(patch.surface, options)) {
    KnownFruit& fruit = found.emplace_back();
    FruitEstimate& e = fruit.estimate;
    e.points = static_cast<int>(separated.points.size());
    Eigen::Array3d color = Eigen::Array3d::Zero();
    std::array<int, kPixelLabels> votes{};
    double fruit_share = 0.0;
    for (const int i : separated.points) {
      const SurfaceVertex& v = *patch.vertex[static_cast<std::size_t>(i)];
      fruit.cells.push_back(voxel_key(v.cell));
      fruit.blocks.push_back(patch.block[static_cast<std::size_t>(i)]);
      color += Eigen::Array3d(v.color.r, v.color.g, v.color.b);
      ++votes[static_cast<std::size_t>(v.kind)];
      fruit_share += static_cast<double>(v.fruit_share);
    }
    sort_unique(fruit.cells);
    sort_unique(fruit.blocks);
    color = color / e.points + 0.5;
    e.color = {static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
               static_cast<std::uint8_t>(color[2])};
    e.ripeness =
        static_cast<PixelLabel>(std::max_element(votes.begin() + 1, votes.end()) - votes.begin());
    e.centre = separated.shape.centre;
    fruit.seen.fruit_share = fruit_share / e.points;
    fruit.seen.normal_spread = normal_spread(patch.surface, separated.points);
    fruit.seen.foreign_share = foreign_share(separated.shape, fruit);
    fruit.surface.reserve(separated.points.size());
    for (const int i : separated.points) {
      fruit.surface.push_back(patch.surface[static_cast<std::size_t>(i)]);
    }
  }
}

/// Of the surface around the fruit that lies on its shape and faces the same way, how much pixels
/// took for something else: the rest of the leaf when the fruit is a red spot on one.
double FruitMap::State::foreign_share(const ShapeEstimate& shape, const KnownFruit& fruit) const {
  constexpr double kOnShape_m = 0.008;
  constexpr double kMinCos = 0.7;
  int foreign = 0;
  for (const int block : fruit.blocks) {
    for (const SurfaceVertex& v : surface.vertices(block)) {
      if (counts(v)) continue;
      const SurfacePoint& s = v.surface;
      const bool on_shape = std::abs(shape.radial_distance(s.point)) < kOnShape_m;
      foreign += on_shape && shape.normal_at(s.point).dot(s.normal) > kMinCos;
    }
  }
  return static_cast<double>(foreign) / (foreign + fruit.estimate.points);
}

/// Of a shape's surface the share that lies well in the open: cameras looked through there.
double FruitMap::State::free_share(const std::vector<SurfacePoint>& shape) const {
  constexpr double kInside_m = 0.004;
  const auto open = static_cast<float>(0.5 * options.tsdf.truncation_m);
  int free = 0;
  for (const SurfacePoint& s : shape) {
    const Vec3 inside = s.point - kInside_m * s.normal;
    const auto distance = surface.tsdf().distance_at(voxel_at(inside, options.tsdf.voxel_m));
    free += distance && *distance > open;
  }
  return static_cast<double>(free) / static_cast<double>(shape.size());
}

/// Fits the fruit's shape, unless it is the one it was before; from there on when it was there.
void FruitMap::State::measure(KnownFruit& fruit, const KnownFruit* before,
                              const std::vector<int>& changed, bool anew) {
  FruitEstimate& e = fruit.estimate;
  const bool unchanged =
      before != nullptr && before->cells == fruit.cells && !share_element(fruit.blocks, changed);
  if (unchanged) {
    fruit.fit = before->fit;
    e.seen_share = before->estimate.seen_share;
    fruit.seen.free_share = before->seen.free_share;
  } else {
    std::optional<Superellipsoid> from;
    if (before != nullptr && !anew) from = before->fit.body;
    fruit.fit = fit_superellipsoid(fruit.surface, from ? again_options : fit_options, from);
    ++fits;
    constexpr int kSamples = 128;
    const std::vector<SurfacePoint> samples = fruit.fit.body.surface_samples(kSamples);
    e.seen_share = missing_surface(samples, fruit.surface).seen_share();
    fruit.seen.free_share = free_share(samples);
  }
  fruit.surface = {};
  set_shape(fruit.fit, e);
  e.place = place_in_rows(options.rows, e.centre);
  if (before != nullptr) {
    e.views = before->estimate.views;
    e.first_seen_s = before->estimate.first_seen_s;
    e.last_seen_s = before->estimate.last_seen_s;
  }
}

/// A frame is a view of a fruit when its fruit pixels lie in most of the fruit's blocks it could.
/// Earlier frames than those since the last update count for fruits that are new: they have seen
/// them while they were waiting.
void FruitMap::State::count_views() {
  std::vector<char> is_new;
  for (const KnownFruit& fruit : known) is_new.push_back(fruit.estimate.views == 0);
  int oldest = updates + 1;
  for (const int since : waits_since) {
    if (since != kNotWaiting) oldest = std::min(oldest, since);
  }
  for (const Sight& sight : sights) {
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (sight.update != updates && is_new[i] == 0) continue;
      if (!share_element(known[i].blocks, sight.blocks)) continue;
      FruitEstimate& e = known[i].estimate;
      if (e.views == 0) e.first_seen_s = sight.time_s;
      e.last_seen_s = sight.time_s;
      ++e.views;
    }
  }
  std::erase_if(sights, [&](const Sight& sight) { return sight.update < oldest; });
}

void FruitMap::State::hand_out() {
  fruits.clear();
  candidates.clear();
  for (KnownFruit& fruit : known) {
    const double cell_cm = 100.0 * options.tsdf.voxel_m;
    fruit.evidence = evidence_of(fruit.estimate, options, cell_cm * cell_cm, fruit.seen);
    fruit.estimate.confidence = options.confidence(fruit.evidence);
    candidates.push_back(fruit.estimate);
    if (fruit.estimate.confidence >= options.min_confidence) fruits.push_back(fruit.estimate);
  }
}

FruitMap::FruitMap(const FruitMapOptions& options) : state_(std::make_unique<State>(options)) {
  CANOPEER_CHECK(options.validate().has_value(), "validate options where they come from");
}
FruitMap::~FruitMap() = default;
FruitMap::FruitMap(FruitMap&&) noexcept = default;
FruitMap& FruitMap::operator=(FruitMap&&) noexcept = default;

void FruitMap::add(const RgbdFrame& frame, const Mask& fruit) {
  state_->surface.add(frame, fruit);
  state_->sights.push_back(
      {frame.time_s, state_->surface.tsdf().seen_in_last_frame(), state_->updates + 1});
}

void FruitMap::update() {
  state_->update(state_->update_surface(state_->options.update_blocks), false);
}

void FruitMap::update_all() {
  state_->update(state_->update_surface(std::numeric_limits<int>::max()), true);
}

/// Of the patches around what has changed those whose turn it is. `concerned`: their blocks, and
/// changed ones where no fruit is left.
std::vector<Patch> FruitMap::State::take_patches(const std::vector<int>& changed, bool all,
                                                 std::vector<int>& concerned) {
  std::vector<Patch> patches = patches_around(changed);
  std::vector<char> has_known(waits_since.size(), 0);
  for (const KnownFruit& fruit : known) {
    for (const int block : fruit.blocks) has_known[block] = 1;
  }
  for (Patch& patch : patches) {
    patch.since = updates;
    for (const int block : patch.blocks) {
      patch.known = patch.known || has_known[block] != 0;
      if (waits_since[block] != kNotWaiting) {
        patch.since = std::min(patch.since, waits_since[block]);
      }
    }
  }
  std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
    return std::make_tuple(a.known, a.since) < std::make_tuple(b.known, b.since);
  });
  std::size_t taken = 0;
  int points = 0;
  for (; taken < patches.size(); ++taken) {
    if (!patches[taken].known) continue;
    const bool is_first = points == 0;
    points += patches[taken].points;
    if (!all && !is_first && points > options.update_points) break;
  }
  std::vector<char> left(waits_since.size(), 0);
  for (std::size_t i = taken; i < patches.size(); ++i) {
    for (const int block : patches[i].blocks) left[block] = 1;
  }
  patches.resize(taken);
  for (Patch& patch : patches) {
    collect_surface(patch);
    concerned.insert(concerned.end(), patch.blocks.begin(), patch.blocks.end());
  }
  // Where fruit is gone beside a patch that waits, that patch's fruit may have lost it: both wait.
  const FruitTsdf& tsdf = surface.tsdf();
  for (const int block : changed) {
    const auto& around = tsdf.blocks()[static_cast<std::size_t>(block)]->around;
    const bool waits = std::any_of(around.begin(), around.end(),
                                   [&](int other) { return other >= 0 && left[other] != 0; });
    if (!waits) concerned.push_back(block);
  }
  sort_unique(concerned);
  for (const int block : concerned) waits_since[block] = kNotWaiting;
  return patches;
}

void FruitMap::State::update(const std::vector<int>& new_changes, bool all) {
  State& s = *this;
  ++updates;
  waits_since.resize(surface.tsdf().blocks().size(), kNotWaiting);
  for (const int block : new_changes) {
    if (waits_since[block] == kNotWaiting) waits_since[block] = updates;
  }
  std::vector<int> changed;
  for (std::size_t block = 0; block < waits_since.size(); ++block) {
    if (all || waits_since[block] != kNotWaiting) changed.push_back(static_cast<int>(block));
  }
  std::vector<int> concerned;
  std::vector<KnownFruit> found;
  for (Patch& patch : take_patches(changed, all, concerned)) {
    drop_odd_pieces(patch);
    solve(patch, found);
  }
  std::vector<KnownFruit> before;
  std::vector<KnownFruit> after;
  for (KnownFruit& fruit : s.known) {
    (share_element(fruit.blocks, concerned) ? before : after).push_back(std::move(fruit));
  }
  std::vector<TrackedFruit> tracked;
  std::vector<TrackedFruit> tracked_before;
  for (const KnownFruit& f : found) tracked.push_back({-1, f.estimate.centre, f.cells});
  for (const KnownFruit& f : before) {
    tracked_before.push_back({f.estimate.id, f.estimate.centre, f.cells});
  }
  s.tracker.assign(tracked, tracked_before);
  const auto& changes = s.tracker.changes();
  s.id_changes.insert(s.id_changes.end(), changes.begin(), changes.end());
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].estimate.id = tracked[i].id;
    const auto same = std::find_if(before.begin(), before.end(), [&](const KnownFruit& f) {
      return f.estimate.id == tracked[i].id;
    });
    s.measure(found[i], same == before.end() ? nullptr : &*same, changed, all);
    after.push_back(std::move(found[i]));
  }
  std::sort(after.begin(), after.end(),
            [](const KnownFruit& a, const KnownFruit& b) { return a.estimate.id < b.estimate.id; });
  s.known = std::move(after);
  s.count_views();
  s.hand_out();
}

const std::vector<FruitEstimate>& FruitMap::fruits() const { return state_->fruits; }
const std::vector<FruitEstimate>& FruitMap::candidates() const { return state_->candidates; }
FruitEvidence FruitMap::evidence(std::size_t i) const { return state_->known[i].evidence; }
const std::vector<IdChange>& FruitMap::id_changes() const { return state_->id_changes; }
int FruitMap::waiting() const {
  const auto& since = state_->waits_since;
  const auto idle = std::count(since.begin(), since.end(), State::kNotWaiting);
  return static_cast<int>(since.size()) - static_cast<int>(idle);
}
int FruitMap::fits() const { return state_->fits; }

PointCloud FruitMap::cloud() const {
  PointCloud cloud;
  const std::size_t blocks = state_->surface.tsdf().blocks().size();
  for (std::size_t block = 0; block < blocks; ++block) {
    for (const SurfaceVertex& v : state_->surface.vertices(static_cast<int>(block))) {
      if (!state_->counts(v)) continue;
      cloud.points.push_back(v.surface.point.cast<float>());
      cloud.normals.push_back(v.surface.normal.cast<float>());
      cloud.colors.push_back(v.color);
    }
  }
  return cloud;
}

SurfaceMesh FruitMap::surface() const {
  SurfaceMesh whole = state_->surface.mesh();
  std::unordered_map<std::uint64_t, int> fruit_of_cell;  // never iterated
  for (const KnownFruit& fruit : state_->known) {
    if (fruit.estimate.confidence < state_->options.min_confidence) continue;
    for (const std::uint64_t cell : fruit.cells) fruit_of_cell[cell] = fruit.estimate.id;
  }
  SurfaceMesh mesh;
  std::vector<std::uint32_t> place(whole.vertices.size(), 0);
  std::vector<char> kept(whole.vertices.size(), 0);
  for (std::size_t i = 0; i < whole.vertices.size(); ++i) {
    const SurfaceVertex& v = whole.vertices[i];
    if (!state_->counts(v)) continue;
    kept[i] = 1;
    place[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(v);
    const auto fruit = fruit_of_cell.find(voxel_key(v.cell));
    mesh.fruit.push_back(fruit == fruit_of_cell.end() ? -1 : fruit->second);
  }
  for (const auto& t : whole.triangles) {
    if (kept[t[0]] == 0 || kept[t[1]] == 0 || kept[t[2]] == 0) continue;
    mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  return mesh;
}

}  // namespace canopeer
