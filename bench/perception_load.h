#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "canopeer/planner/planner.h"
#include "canopeer/planner/vmp/vmp_planner.h"
#include "support/first_stop.h"

namespace canopeer {

/// The scene that a planner gets at the first stop; tasks in other threads read `snapshot`.
PlanningScene planning_scene(const test::FirstStop& stop, const ExactChecker& judge,
                             const CostTable& costs,
                             std::shared_ptr<const MapSnapshot> snapshot = nullptr);

/// A planner that has begun there, heard of the home frame, and taken the arm's place into its
/// graph.
std::unique_ptr<VmpPlanner> begun_planner(const VmpOptions& options, const PlanningScene& scene,
                                          MapChange home);

/// A thread that searches one graph over and over on the newest snapshot, with nothing known of
/// what its views see: the load that decisions are at their worst.
class SearchLoad {
 public:
  /// On a graph of `nodes` views.
  SearchLoad(const test::FirstStop& stop, const FrontierTargets& targets, int nodes,
             std::shared_ptr<const MapSnapshot> snapshot);

  void look_at(std::shared_ptr<const MapSnapshot> snapshot);
  [[nodiscard]] int searches() const { return searches_; }

 private:
  void search_until_told(const std::stop_token& stop);

  ViewGraph graph_;
  NodeId start_{};
  std::mutex mutex_;
  std::shared_ptr<const MapSnapshot> snapshot_;
  std::atomic<int> searches_ = 0;
  std::jthread thread_;  // last, so that it ends first
};

}  // namespace canopeer
