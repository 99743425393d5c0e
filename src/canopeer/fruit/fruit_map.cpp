#include "canopeer/fruit/fruit_map.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <unordered_map>

#include "canopeer/base/check.h"
#include "canopeer/fruit/surface/voxel_key.h"
#include "canopeer/fruit/updates/fruit_map_state.h"

namespace canopeer {

FruitMap::FruitMap(const FruitMapOptions& options) : state_(std::make_unique<State>(options)) {
  CANOPEER_CHECK(options.validate().has_value(), "validate options where they come from");
}
FruitMap::~FruitMap() = default;
FruitMap::FruitMap(const FruitMap& other) : state_(std::make_unique<State>(*other.state_)) {}
FruitMap& FruitMap::operator=(const FruitMap& other) { return *this = FruitMap(other); }
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
  s.judge();
  s.hand_out();
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

void FruitMap::State::judge() {
  const double cell_cm = 100.0 * options.tsdf.voxel_m;
  for (KnownFruit& fruit : known) {
    fruit.evidence = evidence_of(fruit.estimate, options, cell_cm * cell_cm, fruit.seen);
    fruit.estimate.confidence = options.confidence(fruit.evidence);
  }
}

void FruitMap::State::hand_out() {
  fruits.clear();
  candidates.clear();
  for (const KnownFruit& fruit : known) {
    candidates.push_back(fruit.estimate);
    if (fruit.estimate.confidence >= options.min_confidence) fruits.push_back(fruit.estimate);
  }
}

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
