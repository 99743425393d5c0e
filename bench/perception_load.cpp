#include "perception_load.h"

#include <utility>

#include "canopeer/search/path_search.h"
#include "canopeer/viewgraph/graph_builder.h"

namespace canopeer {

PlanningScene planning_scene(const test::FirstStop& stop, const ExactChecker& judge,
                             const CostTable& costs, std::shared_ptr<const MapSnapshot> snapshot) {
  return {.robot = &stop.robot,
          .ik = &stop.ik,
          .map = &stop.perception.map(),
          .checker = &stop.checker,
          .judge = &judge,
          .costs = &costs,
          .snapshot = std::move(snapshot),
          .segment = stop.frame,
          .seed = 1};
}

std::unique_ptr<VmpPlanner> begun_planner(const VmpOptions& options, const PlanningScene& scene,
                                          MapChange home) {
  auto planner = std::make_unique<VmpPlanner>(options);
  planner->begin_segment(scene);
  home.snapshot = scene.snapshot;
  planner->map_changed(std::move(home));
  WorkMeter work;
  static_cast<void>(planner->decide(scene.segment.home, work));
  return planner;
}

SearchLoad::SearchLoad(const test::FirstStop& stop, const FrontierTargets& targets, int nodes,
                       std::shared_ptr<const MapSnapshot> snapshot)
    : snapshot_(std::move(snapshot)) {
  GraphBuilderOptions options;
  options.max_nodes = nodes;
  GraphBuilder builder(graph_, stop.frame, stop.robot, stop.ik, options, 7);
  builder.set_targets(snapshot_->map, targets, {});
  WorkMeter work;
  start_ =
      builder.add_start(stop.frame.home, snapshot_->checker,
                        stop.frame.T_world_base * stop.robot.T_base_camera(stop.frame.home), work);
  while (!builder.resting()) builder.grow(snapshot_->map, snapshot_->checker, work);
  thread_ = std::jthread([this](const std::stop_token& told) { search_until_told(told); });
}

void SearchLoad::look_at(std::shared_ptr<const MapSnapshot> snapshot) {
  const std::lock_guard<std::mutex> lock(mutex_);
  snapshot_ = std::move(snapshot);
}

void SearchLoad::search_until_told(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::shared_ptr<const MapSnapshot> snapshot;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      snapshot = snapshot_;
    }
    ViewGraph graph = graph_;  // without casts
    WorkMeter work;
    static_cast<void>(search_path(graph, start_, snapshot->map, {}, work));
    ++searches_;
  }
}

}  // namespace canopeer
