#include "canopeer/bounds/visibility/segment_sampler.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "canopeer/robot/arm_reach.h"

namespace canopeer {
namespace {

// Of every kRound samples so many are aimed at fruits, one after the other, and so many have the
// camera in the workspace; the others are anywhere.
constexpr std::uint64_t kRound = 20;
constexpr std::uint64_t kAimed = 13;
constexpr std::uint64_t kInWorkspace = 4;
constexpr std::size_t kMostTimes = 32;  // that a patch is aimed at again

/// Farthest that a pixel's surface may be, Euclidean.
double farthest_m(const CameraIntrinsics& camera) {
  double slope2 = 0.0;
  for (const int u : {0, camera.width - 1}) {
    for (const int v : {0, camera.height - 1}) {
      slope2 = std::max(slope2, camera.ray(u, v).squaredNorm());
    }
  }
  return camera.max_range_m * std::sqrt(slope2);
}

/// Whatever may be seen from where the arm reaches, or hide something there.
std::vector<NumberedPart> parts_near(const SampledWorld& world, const SegmentFrame& frame,
                                     const CutFruits& fruits, const CameraIntrinsics& camera) {
  const Vec3 base = frame.T_world_base.translation();
  const Vec3 reach = Vec3::Constant(arm_reach_m(world.robot) + farthest_m(camera));
  const Box box(base - reach, base + reach);
  std::vector<NumberedPart> parts = what_else_is_near(world.scene, box);
  for (const NumberedPart& body : fruits.bodies) {
    if (box.intersects(body.part.mesh.bounds())) parts.push_back(body);
  }
  return parts;
}

void count_in(const PoolView& view, const FruitPatches& patches, PoolState& state) {
  for (const std::uint32_t p : view.patches) {
    const std::uint32_t times = ++state.times_seen[p];
    if (times == 1) {
      ++state.course.patches;
      ++state.course.seen_once;
      state.course.area_cm2 += patches.area_cm2[p];
    } else if (times == 2) {
      --state.course.seen_once;
    }
  }
}

}  // namespace

int fruits_seen(const FruitPatches& patches, const std::vector<std::uint32_t>& times_seen) {
  std::set<int> fruits;
  for (std::size_t p = 0; p < times_seen.size(); ++p) {
    if (times_seen[p] > 0) fruits.insert(patches.fruit[p]);
  }
  return static_cast<int>(fruits.size());
}

std::vector<std::uint32_t> rarely_seen(const std::vector<std::uint32_t>& patches,
                                       const std::vector<std::uint32_t>& times_seen) {
  std::vector<std::uint32_t> rare;
  std::copy_if(patches.begin(), patches.end(), std::back_inserter(rare),
               [&](std::uint32_t p) { return times_seen[p] <= 1; });
  return rare;
}

SegmentSampler::SegmentSampler(const SampledWorld& world, const SegmentFrame& frame,
                               const CutFruits& fruits, const CameraIntrinsics& camera,
                               std::uint64_t seed)
    : SegmentSampler(world, frame, fruits, camera, seed, parts_near(world, frame, fruits, camera)) {
}

SegmentSampler::SegmentSampler(const SampledWorld& world, const SegmentFrame& frame,
                               const CutFruits& fruits, const CameraIntrinsics& camera,
                               std::uint64_t seed, const std::vector<NumberedPart>& near)
    : world_(world),
      frame_(frame),
      camera_(camera),
      seed_(seed),
      free_(world.robot, world.ik, world.scene, world.judge, frame, camera.min_range_m,
            camera.max_range_m),
      picture_(near),
      sights_(near),
      points_(fruits.points) {
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    if (free_.may_be_in_range(points_[p].front())) patches_near_.push_back(p);
  }
}

int SegmentSampler::least_samples(int aimed) const {
  const auto wanted = static_cast<std::uint64_t>(aimed) * free_.fruits().size();
  return static_cast<int>((wanted * kRound + kAimed - 1) / kAimed);
}

std::optional<Configuration> SegmentSampler::draw_at(std::uint32_t patch,
                                                     const std::string& stream) const {
  Rng rng(seed_, stream, patch);
  const std::vector<Vec3>& points = points_[patch];
  const Vec3& target = points[rng.index(points.size())];
  return free_.at_point(
      target, [&](const Vec3& from) { return sights_.clear(from, target); }, rng);
}

std::optional<Configuration> SegmentSampler::draw(std::uint64_t number) const {
  Rng rng(seed_, "view pool, segment " + std::to_string(frame_.index), number);
  const std::uint64_t in_round = number % kRound;
  if (in_round < kAimed && !free_.fruits().empty()) {
    const std::uint64_t shot = number / kRound * kAimed + in_round;
    return free_.aimed(shot % free_.fruits().size(), rng);
  }
  if (in_round < kAimed + kInWorkspace) return free_.in_workspace(rng);
  return free_.anywhere(rng);
}

PoolView SegmentSampler::look(const Configuration& q) const {
  PoolView view;
  view.q = q;
  view.T_world_camera = frame_.T_world_base * world_.robot.T_base_camera(q);
  picture_.see(camera_, view.T_world_camera, view.patches);
  return view;
}

void SegmentSampler::look_from_home(PoolState& state) const {
  state.course.segment = frame_.index;
  state.course.sampled = 1;
  state.views.push_back(look(frame_.home));
  count_in(state.views.back(), state.pool.patches, state);
}

void SegmentSampler::take_in(std::vector<std::optional<PoolView>> found, PoolState& state) const {
  for (auto& view : found) {
    if (!view) continue;
    ++state.course.sampled;
    if (view->patches.empty()) continue;
    count_in(*view, state.pool.patches, state);
    state.views.push_back(std::move(*view));
  }
  state.course.fruits = fruits_seen(state.pool.patches, state.times_seen);
  state.pool.course.push_back(state.course);
}

void SegmentSampler::sample(int count, PoolState& state) const {
  const auto plain = static_cast<std::size_t>(count);
  const std::uint64_t first = static_cast<std::uint64_t>(state.batches) * plain;
  std::vector<std::uint32_t> rare;
  if (state.batches > 0) rare = rarely_seen(patches_near_, state.times_seen);
  const std::string stream = "patches of segment " + std::to_string(frame_.index) + ", batch " +
                             std::to_string(state.batches);
  std::vector<std::optional<PoolView>> found(plain + rare.size());
  oneapi::tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const auto q = i < plain ? draw(first + i) : draw_at(rare[i - plain], stream);
    if (q) found[i] = look(*q);
  });
  ++state.batches;
  take_in(std::move(found), state);
}

void SegmentSampler::aim_again(const std::vector<std::uint32_t>& patches, std::int64_t tries,
                               int round, PoolState& state) const {
  const std::string stream = "patches again, segment " + std::to_string(frame_.index) + ", round " +
                             std::to_string(round) + ", ";
  std::vector<std::uint32_t> near;
  std::set_intersection(patches.begin(), patches.end(), patches_near_.begin(), patches_near_.end(),
                        std::back_inserter(near));
  if (near.empty()) return;
  const std::size_t often =
      std::clamp<std::size_t>(static_cast<std::size_t>(tries) / near.size(), 1, kMostTimes);
  std::vector<std::optional<PoolView>> found(near.size() * often);
  oneapi::tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const auto q = draw_at(near[i / often], stream + std::to_string(i % often));
    if (q) found[i] = look(*q);
  });
  take_in(std::move(found), state);
}

}  // namespace canopeer
