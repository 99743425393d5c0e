#include "canopeer/planner/vmp/vmp_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/geometry/state_archive.h"
#include "canopeer/robot/straight_timing.h"
#include "canopeer/search/random_walk.h"
#include "canopeer/search/view_casts.h"

namespace canopeer {
namespace {

/// Drops the voxels without a 6-neighbour that is both occupied and ROI.
void keep_roi_neighbors(const VoxelMap& map, std::vector<VoxelIndex>& voxels) {
  std::erase_if(voxels, [&](const VoxelIndex& voxel) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        const VoxelIndex neighbor = voxel + step * VoxelIndex::Unit(axis);
        if (map.is_roi(neighbor) && map.occupancy(neighbor) == Occupancy::occupied) return false;
      }
    }
    return true;
  });
}

/// As sketches name views.
std::int32_t number(NodeId id) { return static_cast<std::int32_t>(id); }

struct BatchTask : BackgroundTask {
  BatchTask(GraphBuilder::Batch b, std::shared_ptr<const MapSnapshot> s)
      : batch(std::move(b)), snapshot(std::move(s)) {}
  void run() override { batch.run(); }
  GraphBuilder::Batch batch;
  std::shared_ptr<const MapSnapshot> snapshot;  // that the batch reads
};

}  // namespace

VmpPlanner::VmpPlanner(const VmpOptions& options)
    : options_(options), finder_(options.finder ? options.finder() : nullptr) {
  CANOPEER_CHECK((options_.search == VmpOptions::Search::other) == (finder_ != nullptr),
                 "another search comes with its finder");
}

void VmpPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  graph_.clear();
  GraphBuilderOptions builder = options_.builder;
  builder.sharp = scene_.sharp;
  builder_ = std::make_unique<GraphBuilder>(
      graph_, scene_.segment, *scene_.robot, *scene_.ik, builder,
      Rng(scene_.seed, "segment", static_cast<std::uint64_t>(scene_.segment.index)).bits());
  path_.clear();
  goal_.reset();
  started_ = false;
  searched_ = false;
  executed_rad_ = 0.0;
  path_age_s_ = 0.0;
  credit_s_ = 0.0;
  waited_s_ = 0.0;
  stood_s_ = 0.0;
  search_just_ran_ = false;
  counts_ = {};
  time_left_s_ = scene_.time_left_s;
  targets_ = {};
  if (finder_) finder_->begin_segment();
}

void VmpPlanner::map_changed(MapChange change) {
  stood_s_ = 0.0;
  scene_.snapshot = std::move(change.snapshot);
  if (options_.occupied_means_roi) keep_roi_neighbors(*scene_.map, change.targets.occupied);
  graph_.invalidate_casts(change.blocks);
  if (finder_) targets_ = change.targets;
  std::vector<NodeId> keep = path();
  if (goal_) keep.push_back(*goal_);
  builder_->set_targets(*scene_.map, std::move(change.targets), keep);
}

Decision VmpPlanner::decide(const Configuration& q, WorkMeter& work) {
  arrive(q, work);
  if (look_ahead_used_up() || !worth_following(work)) path_.clear();
  // Each round takes an edge out of the graph, so this ends.
  while (true) {
    if (path_.empty()) {
      if (!ready_to_search()) return hold();
      plan(work);
      if (path_.empty()) return hold();
    }
    const PathStep step = path_.front();
    if (edge_clear(at_, step.node, work)) return go(q, step);
    graph_.remove_edge(at_, step.node);
    ++counts_.blocked_edges;
    path_.clear();
  }
}

bool VmpPlanner::ready_to_search() const {
  if (stood_s_ < options_.stand_still_s) return false;
  return searched_ || graph_.node_count() >= options_.min_nodes || builder_->resting() ||
         waited_s_ > options_.max_wait_s / 2;
}

void VmpPlanner::time_passes(double seconds) {
  stood_s_ += seconds;
  path_age_s_ += seconds;
  waited_s_ += seconds;
  time_left_s_ -= seconds;
}

std::unique_ptr<BackgroundTask> VmpPlanner::next_task() {
  if (!builder_ || builder_->resting()) return nullptr;
  const VoxelMap& map = scene_.snapshot ? scene_.snapshot->map : *scene_.map;
  return std::make_unique<BatchTask>(builder_->next_batch(map, background_checker()),
                                     scene_.snapshot);
}

void VmpPlanner::finish_task(BackgroundTask& task, WorkMeter& work) {
  auto* batch = dynamic_cast<BatchTask*>(&task);
  CANOPEER_CHECK(batch != nullptr, "a task this planner made");
  builder_->join(std::move(batch->batch), background_checker(), work);
}

const CollisionChecker& VmpPlanner::background_checker() const {
  return scene_.snapshot ? scene_.snapshot->checker : *scene_.checker;
}

void VmpPlanner::grow(double budget_s, WorkMeter& work) {
  time_passes(budget_s);
  if (std::exchange(search_just_ran_, false) && options_.rest_while_searching) return;
  credit_s_ += budget_s;
  while (credit_s_ > 0.0) {
    const auto task = next_task();
    if (!task) break;
    task->run();
    WorkMeter batch;
    finish_task(*task, batch);
    credit_s_ -= batch.seconds(*scene_.costs);
    work.merge(batch);
  }
  credit_s_ = std::min(credit_s_, 0.0);  // time not used is gone
}

PlannerStatus VmpPlanner::status() const {
  PlannerStatus status = counts_;
  status.graph_nodes = graph_.node_count();
  status.graph_edges = graph_.edge_count();
  return status;
}

PlanSketch VmpPlanner::sketch() const {
  PlanSketch sketch;
  for (std::size_t i = 0; i < graph_.id_count(); ++i) {
    const auto id = static_cast<NodeId>(i);
    const ViewNode& node = graph_.node(id);
    if (node.removed) continue;
    const ViewPose& view = node.view;
    sketch.views.push_back({view.T_world_camera, view.kind, node.visited, number(id)});
    for (const ViewEdge& edge : node.edges) {
      if (id < edge.to) sketch.edges.push_back({number(id), number(edge.to), edge.time_s});
    }
  }
  for (const PathStep& step : path_) sketch.path.push_back(number(step.node));
  if (started_) sketch.at = number(at_);
  return sketch;
}

Expected<std::string> VmpPlanner::state() const {
  if (!builder_) return fail("no segment has begun");
  // The other searches look at no cast of an earlier one.
  const bool kept = options_.search == VmpOptions::Search::best_first || finder_;
  return state_bytes(*this, kept ? graph_.with_casts() : std::vector<NodeId>(),
                     finder_ ? finder_->state() : std::string());
}

Expected<void> VmpPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  std::vector<NodeId> with_casts;
  std::string finder;
  if (auto ok = read_state_bytes(state, *this, with_casts, finder); !ok) return ok;
  if (finder_) {
    if (auto ok = finder_->restore(finder); !ok) return ok;
  }
  // What a view would see is kept only as long as no block its rays cross has changed, so a cast
  // on the present map gives the same. It was paid for when it was first made.
  WorkMeter paid;
  const PathSearchOptions& o = options_.path_search;
  ensure_casts(graph_, with_casts, *scene_.map, o.fan, paid, o.cast);
  return {};
}

std::vector<NodeId> VmpPlanner::path() const {
  std::vector<NodeId> ids;
  for (const auto& step : path_) ids.push_back(step.node);
  return ids;
}

/// Makes the node the arm stands at the current one and marks it visited.
void VmpPlanner::arrive(const Configuration& q, WorkMeter& work) {
  const NodeId expected = goal_.value_or(at_);
  goal_.reset();
  if (started_ &&
      endless().distance(q, graph_.node(expected).view.q) <= options_.arrival_tolerance_rad) {
    at_ = expected;
    graph_.node(at_).visited = true;
    return;
  }
  insert_off_pose(q, work);
}

/// The arm is where no node is (at the start, after a move home, or off the planned pose): the
/// graph gets a node there, with a collision-free edge back to the path if there is one; without,
/// the path is given up.
void VmpPlanner::insert_off_pose(const Configuration& q, WorkMeter& work) {
  const Pose T_world_camera = scene_.segment.T_world_base * scene_.robot->T_base_camera(q);
  ++counts_.off_pose_nodes;
  at_ = builder_->add_start(q, *scene_.checker, T_world_camera, work);
  started_ = true;
  if (path_.empty()) return;
  const NodeId next = path_.front().node;
  if (edge_clear(at_, next, work)) {
    const Configuration to = endless().nearest(graph_.node(next).view.q, q);
    graph_.connect(at_, next, straight_motion_time(q, to, *scene_.robot, scene_.sharp));
  } else {
    path_.clear();
  }
}

void VmpPlanner::plan(WorkMeter& work) {
  builder_->join_start(at_, *scene_.checker, work);
  ViewPath path;
  if (options_.search == VmpOptions::Search::best_first) {
    path = search_path(graph_, at_, *scene_.map, options_.path_search, work);
  } else if (options_.search == VmpOptions::Search::released) {
    path = search_released(graph_, at_, *scene_.map, options_.released_search, *scene_.costs, work);
  } else if (finder_) {
    path = finder_->find(query(), work);
  } else {
    Rng rng(scene_.seed, "random walk",
            (static_cast<std::uint64_t>(scene_.segment.index) << 32) + walks_++);
    path = random_walk(graph_, at_, options_.random_walk_views, rng);
  }
  path_.assign(path.steps.begin(), path.steps.end());
  executed_rad_ = 0.0;
  path_age_s_ = 0.0;
  searched_ = true;
  ++counts_.searches;
  search_just_ran_ = true;
}

PathQuery VmpPlanner::query() {
  return {&graph_,      at_,          scene_.map,  &targets_,   &scene_.segment,
          scene_.robot, scene_.costs, scene_.seed, time_left_s_};
}

bool VmpPlanner::worth_following(WorkMeter& work) {
  if (!finder_ || path_.empty() || executed_rad_ == 0.0) return true;
  return finder_->keeps(query(), work);
}

bool VmpPlanner::look_ahead_used_up() const {
  if (path_.empty() || executed_rad_ == 0.0) return false;  // one edge is always taken
  const double next = graph_.distance_rad(at_, path_.front().node);
  const bool old = options_.replan_after_s > 0.0 && path_age_s_ > options_.replan_after_s;
  return old || executed_rad_ + next > options_.look_ahead_rad;
}

bool VmpPlanner::edge_clear(NodeId a, NodeId b, WorkMeter& work) const {
  int states = 0;
  const Configuration& q_a = graph_.node(a).view.q;
  const Configuration q_b = endless().nearest(graph_.node(b).view.q, q_a);
  const bool clear = scene_.checker->edge_free(q_a, q_b, &states);
  work.add(Work::state_check, states);
  // The sphere cover rounds up. Close to leaves that would hold the arm where it is, so the real
  // geometry decides. It knows what is mapped only, so not where unknown space blocks.
  if (clear || scene_.checker->options().unknown_blocks) return clear;
  return judged_clear(q_a, q_b, work);
}

bool VmpPlanner::judged_clear(const Configuration& a, const Configuration& b,
                              WorkMeter& work) const {
  const int steps =
      std::max(1, static_cast<int>(std::ceil(joint_distance(a, b) / options_.judge_step_rad)));
  for (int i = 0; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    work.add(Work::exact_state);
    if (scene_.judge->check(a + s * (b - a), scene_.segment.trolley, scene_.map).any())
      return false;
  }
  return true;
}

/// Along the edge from where the arm is, `q`, whole turns from the node or not.
Decision VmpPlanner::go(const Configuration& q, const PathStep& step) {
  const ViewNode& from = graph_.node(at_);
  const ViewNode& to = graph_.node(step.node);
  Decision decision;
  decision.action = Decision::Action::move;
  decision.motion.waypoints = {endless().nearest(from.view.q, q),
                               endless().goal(q, from.view.q, to.view.q)};
  decision.motion.T_world_camera = to.view.T_world_camera;
  decision.motion.kind = to.view.kind;
  if (options_.search != VmpOptions::Search::random_walk)
    decision.motion.predicted_gain = step.new_unknown;
  executed_rad_ += graph_.distance_rad(at_, step.node);
  goal_ = step.node;
  path_.pop_front();
  waited_s_ = 0.0;
  return decision;
}

Decision VmpPlanner::hold() {
  Decision decision;
  decision.action =
      waited_s_ > options_.max_wait_s ? Decision::Action::stuck : Decision::Action::wait;
  if (finder_ && finder_->done()) decision.action = Decision::Action::done;
  return decision;
}

}  // namespace canopeer
