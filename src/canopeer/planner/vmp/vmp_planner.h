#pragma once

#include <deque>
#include <memory>

#include "canopeer/planner/planner.h"
#include "canopeer/search/path_finder.h"
#include "canopeer/search/path_search.h"
#include "canopeer/search/released_search.h"
#include "canopeer/search/view_path.h"
#include "canopeer/viewgraph/graph_builder.h"

namespace canopeer {

/// Graph, search and motions of the VmpPlanner.
struct VmpOptions {
  enum class Search {
    best_first,   ///< Algorithm 1 of the paper
    random_walk,  ///< a random path over the same graph, to measure what the search is worth
    released,     ///< the published code's: by accumulated cost
    other         ///< that of `finder`
  };
  GraphBuilderOptions builder;
  PathSearchOptions path_search;
  ReleasedSearchOptions released_search;
  Search search = Search::best_first;
  PathFinderFactory finder;  ///< of another planner on the same graph
  int random_walk_views = 3;
  double look_ahead_rad =
      5.0;  ///< Σ|Δq| executed of a path at most before the next search; one edge is always taken
  double replan_after_s = 0.0;  ///< search again when a path is older than this; 0: never
  int min_nodes = 60;           ///< the first search of a segment waits for this many nodes
  double max_wait_s = 3.0;      ///< waiting longer than this without a motion means stuck
  double arrival_tolerance_rad =
      0.005;                     ///< Σ|Δq| within which the arm is at the node it was sent to
  double judge_step_rad = 0.01;  ///< Σ|Δq| between states judged exactly
  // How the published code goes about it; off in the paper's planner.
  double stand_still_s = 0.0;         ///< graph building with the arm at rest before every search
  bool rest_while_searching = false;  ///< the builder pauses while the search runs
  bool occupied_means_roi = false;  ///< of the occupied frontiers only those of occupied ROI voxels
};

/// View motion planning on a graph: T. Zaenker, J. Rückin, R. Menon, M. Popović, M. Bennewitz,
/// "Graph-based View Motion Planning for Fruit Detection", IROS 2023. Grows a graph of reachable
/// views in the background, searches it for the path of highest utility, goes along it up to the
/// look-ahead, checks each edge again before it is taken. docs/method.md lists each step with its
/// equation and test, and the departures.
class VmpPlanner : public Planner {
 public:
  explicit VmpPlanner(const VmpOptions& options);

  void begin_segment(const PlanningScene& scene) override;
  void map_changed(MapChange change) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  void time_passes(double seconds) override;
  std::unique_ptr<BackgroundTask> next_task() override;
  void finish_task(BackgroundTask& task, WorkMeter& work) override;
  void grow(double budget_s, WorkMeter& work) override;
  [[nodiscard]] PlannerStatus status() const override;
  [[nodiscard]] PlanSketch sketch() const override;
  [[nodiscard]] Expected<std::string> state() const override;
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

  [[nodiscard]] const ViewGraph& graph() const { return graph_; }
  /// Views of the present path still to be taken.
  [[nodiscard]] std::vector<NodeId> path() const;

  /// What has changed since the segment began, but for what the views would see.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(graph_, *builder_, path_, at_, goal_, started_, searched_, executed_rad_, path_age_s_,
            credit_s_, waited_s_, stood_s_, search_just_ran_, walks_, counts_, time_left_s_,
            targets_);
  }

 private:
  void arrive(const Configuration& q, WorkMeter& work);
  void insert_off_pose(const Configuration& q, WorkMeter& work);
  [[nodiscard]] bool ready_to_search() const;
  /// For what may go on while a frame is fused.
  [[nodiscard]] const CollisionChecker& background_checker() const;
  void plan(WorkMeter& work);
  [[nodiscard]] bool look_ahead_used_up() const;
  [[nodiscard]] bool edge_clear(NodeId a, NodeId b, WorkMeter& work) const;
  [[nodiscard]] bool judged_clear(const Configuration& a, const Configuration& b,
                                  WorkMeter& work) const;
  [[nodiscard]] PathQuery query();
  [[nodiscard]] bool worth_following(WorkMeter& work);
  Decision go(const Configuration& q, const PathStep& step);
  Decision hold();
  [[nodiscard]] const EndlessJoints& endless() const { return scene_.robot->endless(); }

  VmpOptions options_;
  PlanningScene scene_;
  ViewGraph graph_;
  std::unique_ptr<GraphBuilder> builder_;
  std::deque<PathStep> path_;   ///< still to be taken
  NodeId at_{};                 ///< the node the arm stands at
  std::optional<NodeId> goal_;  ///< the node it was sent to
  bool started_ = false;
  bool searched_ = false;      ///< in this segment
  double executed_rad_ = 0.0;  ///< of the present path
  double path_age_s_ = 0.0;
  double credit_s_ = 0.0;  ///< background seconds not used yet (negative: owed)
  double waited_s_ = 0.0;
  double stood_s_ = 0.0;          ///< since the last frame
  bool search_just_ran_ = false;  ///< the next background time is that of a search
  std::uint64_t walks_ = 0;
  double time_left_s_ = 0.0;            ///< of the segment
  std::unique_ptr<PathFinder> finder_;  ///< null: a search of its own
  FrontierTargets targets_;             ///< for the finder only
  PlannerStatus counts_;                ///< of the segment; the graph's sizes are not in it
};

}  // namespace canopeer
