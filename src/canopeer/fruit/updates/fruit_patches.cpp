#include <algorithm>
#include <tuple>

#include "canopeer/fruit/instances/euclidean_clusters.h"
#include "canopeer/fruit/instances/piece_filter.h"
#include "canopeer/fruit/updates/fruit_map_state.h"

namespace canopeer {

void FruitMap::State::count_points(int block) {
  const auto& vertices = surface.vertices(block);
  const auto count = std::count_if(vertices.begin(), vertices.end(),
                                   [&](const SurfaceVertex& v) { return counts(v); });
  fruit_points[static_cast<std::size_t>(block)] = static_cast<int>(count);
}

/// The numbers of the blocks whose surface is another now.
std::vector<int> FruitMap::State::update_surface(int max_blocks) {
  std::vector<int> changed = surface.update(max_blocks);
  fruit_points.resize(surface.tsdf().blocks().size(), 0);
  for (const int block : changed) count_points(block);
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
    for (const int other : tsdf.blocks()[static_cast<std::size_t>(block)].around) {
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
      for (const int other : tsdf.blocks()[static_cast<std::size_t>(patch.blocks[next])].around) {
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
    const auto& around = tsdf.blocks()[static_cast<std::size_t>(block)].around;
    const bool waits = std::any_of(around.begin(), around.end(),
                                   [&](int other) { return other >= 0 && left[other] != 0; });
    if (!waits) concerned.push_back(block);
  }
  sort_unique(concerned);
  for (const int block : concerned) waits_since[block] = kNotWaiting;
  return patches;
}

}  // namespace canopeer
