#include "canopeer/planner/playback/playback_planner.h"

#include <cstring>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

/// FNV-1a over all numbers, in order.
std::uint64_t hash_of(const ViewPlan& plan) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&](std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ ((value >> (8 * byte)) & 0xffU)) * 0x100000001b3U;
    }
  };
  for (const auto& views : plan.segments) {
    add(views.size());
    for (const Configuration& q : views) {
      for (const double position : q) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &position, sizeof bits);
        add(bits);
      }
    }
  }
  return hash;
}

}  // namespace

PlaybackPlanner::PlaybackPlanner(ViewPlan plan)
    : plan_(std::move(plan)), plan_hash_(hash_of(plan_)) {}

void PlaybackPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  next_ = 0;
}

std::span<const Configuration> PlaybackPlanner::views() const {
  const auto segment = static_cast<std::size_t>(scene_.segment.index);
  if (segment >= plan_.segments.size()) return {};
  return plan_.segments[segment];
}

Decision PlaybackPlanner::decide(const Configuration& q, WorkMeter& /*work*/) {
  Decision decision;
  decision.action = Decision::Action::done;
  if (next_ >= views().size()) return decision;
  const Configuration& view = views()[next_++];
  CANOPEER_CHECK(view.size() == q.size(), "a plan is held against its robot when it is read");
  decision.action = Decision::Action::move;
  const Configuration goal = scene_.robot->endless().nearest(view, q);
  decision.motion.waypoints = {q, goal};
  decision.motion.T_world_camera = scene_.segment.T_world_base * scene_.robot->T_base_camera(goal);
  return decision;
}

Expected<std::string> PlaybackPlanner::state() const {
  if (scene_.robot == nullptr) return fail("no segment has begun");
  return state_bytes(plan_hash_, next_);
}

Expected<void> PlaybackPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  std::uint64_t hash = 0;
  if (auto ok = read_state_bytes(state, hash, next_); !ok) return ok;
  if (hash == plan_hash_) return {};
  return fail("the plan is not the one that this run began with");
}

Expected<std::unique_ptr<Planner>> make_playback(const PlaybackOptions& options) {
  if (options.plan.empty()) {
    return fail("no plan is named; set playback.plan to a file of views (docs/formats.md)");
  }
  auto plan = read_view_plan(options.plan);
  if (!plan) return tl::unexpected(plan.error());
  if (options.fit) {
    if (auto ok = check_plan(*plan, *options.fit); !ok) {
      return fail_in(options.plan.string(), ok.error());
    }
  }
  return std::make_unique<PlaybackPlanner>(std::move(*plan));
}

}  // namespace canopeer
