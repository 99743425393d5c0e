#include "canopeer/run/simulation_site.h"

#include <chrono>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include "canopeer/run/fruit_colors.h"

namespace canopeer {
namespace {

class SimulationSite : public Site {
 public:
  SimulationSite(Scene scene, const SiteRequest& request)
      : realtime_(request.file.simulation.realtime),
        scene_(std::move(scene)),
        simulation_(request.robot, scene_, first_home(request),
                    request.file.mission.segments.front().trolley, request.file.simulation) {}

  Ports ports() override { return simulation_.ports(); }
  const ExactChecker& judge() const override { return simulation_.judge().checker(); }
  void watch_map(const VoxelMap* map) override { simulation_.watch_map(map); }
  const Scene* truth() const override { return &scene_; }
  Expected<std::string> save() const override {
    if (realtime_) return fail("what happens on the wall clock cannot be put back");
    return simulation_.state();
  }
  Expected<void> restore(std::string_view state) override { return simulation_.restore(state); }

 private:
  static Configuration first_home(const SiteRequest& request) {
    const SegmentPlan& first = request.file.mission.segments.front();
    return request.robot.home("side_" + std::to_string(first.side));
  }

  bool realtime_;
  Scene scene_;
  Simulation simulation_;
};

/// Said once: no motion of the arm makes such a contact or ends it, so none is charged with it.
void say_what_stands_in_contact(const ExactChecker& judge, const SiteRequest& request) {
  if (!request.callbacks.on_notice) return;
  std::set<std::string> links;
  for (const SegmentPlan& segment : request.file.mission.segments) {
    for (std::string& link : judge.resting_contacts(segment.trolley)) links.insert(std::move(link));
  }
  if (links.empty()) return;
  std::string names;
  for (const std::string& link : links) names += (names.empty() ? "" : ", ") + link;
  request.callbacks.on_notice(
      "touching the floor or what else stands there, before the arm moves: " + names +
      "; that is counted as no collision of a motion");
}

std::string import_line(const Scene& scene, double seconds) {
  char text[256];
  std::snprintf(text, sizeof text, "imported %s: %zu triangles, %zu fruits (%d count) in %.1f s",
                scene.name.c_str(), scene.triangle_count(), scene.fruits.size(),
                scene.counted_fruits(), seconds);
  return text;
}

}  // namespace

Expected<ImportedScene> build_world_saying(const WorldSource& source, std::uint64_t seed,
                                           const SiteCallbacks& tell,
                                           const DetectorOptions* detector) {
  const auto begin = std::chrono::steady_clock::now();
  auto built = build_world(source, seed, tell.on_import);
  if (!built) return built;
  if (source.imported() && tell.on_news) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    tell.on_news(import_line(built->scene, took.count()));
  }
  if (!tell.on_notice) return built;
  for (const std::string& text : built->notices) tell.on_notice(text);
  if (detector == nullptr || detector->kind != DetectorOptions().kind) return built;
  if (const auto text = fruit_color_notice(built->scene, detector->colour)) tell.on_notice(*text);
  return built;
}

Expected<std::unique_ptr<Site>> make_simulation_site(const SiteRequest& request) {
  auto built = build_world_saying(request.file.world, request.file.mission.seed, request.callbacks,
                                  &request.file.mission.detector);
  if (!built) return tl::unexpected(built.error());
  auto site = std::make_unique<SimulationSite>(std::move(built->scene), request);
  say_what_stands_in_contact(site->judge(), request);
  return site;
}

}  // namespace canopeer
