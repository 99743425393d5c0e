#include "canopeer/viewgraph/graph_builder.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

constexpr NodeId kNoNode{UINT32_MAX};

/// All kinds of frontier lie within an 18-neighbourhood of something unknown; a target without it
/// has been seen.
bool still_frontier(const VoxelMap& map, const Vec3& target) {
  const VoxelIndex centre = voxel_at(target, map.resolution_m());
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const bool corner = dx != 0 && dy != 0 && dz != 0;
        if (!corner && map.occupancy(centre + VoxelIndex(dx, dy, dz)) == Occupancy::unknown) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

GraphBuilder::GraphBuilder(ViewGraph& graph, const SegmentFrame& frame, const RobotModel& robot,
                           const ArmIk& ik, const GraphBuilderOptions& options, std::uint64_t seed)
    : graph_(&graph),
      robot_(&robot),
      sampler_(frame, robot, ik, options.sampler),
      options_(options),
      seed_(seed),
      start_(kNoNode) {
  graph.set_endless(robot.endless());
}

void GraphBuilder::set_targets(const VoxelMap& map, const FrontierTargets& targets,
                               const std::vector<NodeId>& keep) {
  targets_ = sampler_.targets_in_reach(targets, map.resolution_m(), options_.shares);
  idle_batches_ = 0;
  const bool no_room = graph_->node_count() >= options_.max_nodes;
  for (std::size_t i = 0; i < graph_->id_count(); ++i) {
    const auto id = static_cast<NodeId>(i);
    ViewNode& node = graph_->node(id);
    if (node.visited || node.removed || node.view.kind == TargetKind::none) continue;
    const bool kept = std::find(keep.begin(), keep.end(), id) != keep.end();
    const bool wanted = node.view.kind == TargetKind::roi || (no_room && !kept);
    if (!wanted || still_frontier(map, node.view.target_world)) continue;
    if (no_room && !kept) {
      graph_->remove(id);
    } else {
      node.view.kind = TargetKind::occupied;  // that fruit is seen; the view may still show others
    }
  }
}

NodeId GraphBuilder::add_start(const Configuration& q, const CollisionChecker& checker,
                               const Pose& T_world_camera, WorkMeter& work) {
  ViewPose view;
  view.q = q;
  view.T_world_camera = T_world_camera;
  const NodeId id = graph_->add(std::move(view));
  graph_->node(id).visited = true;
  join_start(id, checker, work);
  return id;
}

void GraphBuilder::join_start(NodeId id, const CollisionChecker& checker, WorkMeter& work) {
  start_ = id;
  int missing = options_.neighbors - open_ways(id);
  if (missing <= 0) return;
  // Close to leaves the nearest ones may all be blocked, so look at a few times k.
  work.add(Work::neighbor_search);
  std::vector<Joint> joints;
  for (const auto& neighbor : graph_->nearest_unvisited(
           graph_->node(id).view.q, static_cast<std::size_t>(4 * options_.neighbors),
           options_.max_start_distance_rad, id)) {
    if (!graph_->edge_time(id, neighbor.id)) joints.push_back({id, neighbor.id});
  }
  check_joints(joints, checker, work);
  for (const auto& joint : joints) {
    if (joint.free && missing-- > 0) connect(joint);
  }
}

int GraphBuilder::open_ways(NodeId id) const {
  const auto& edges = graph_->node(id).edges;
  return static_cast<int>(std::count_if(
      edges.begin(), edges.end(), [&](const ViewEdge& e) { return !graph_->node(e.to).visited; }));
}

bool GraphBuilder::full(TargetKind kind) const {
  const double share = kind == TargetKind::roi        ? options_.shares.roi
                       : kind == TargetKind::occupied ? options_.shares.occupied
                                                      : options_.shares.border;
  return graph_->open_views(kind) >= share * options_.max_nodes;
}

int GraphBuilder::grow(const VoxelMap& map, const CollisionChecker& checker, WorkMeter& work) {
  Batch batch = next_batch(map, checker);
  batch.run();
  return join(std::move(batch), checker, work);
}

GraphBuilder::Batch GraphBuilder::next_batch(const VoxelMap& map, const CollisionChecker& checker) {
  for (const auto kind : {TargetKind::roi, TargetKind::occupied, TargetKind::border}) {
    targets_.close(kind, full(kind));
  }
  Batch batch;
  batch.sampler_ = &sampler_;
  batch.map_ = &map;
  batch.checker_ = &checker;
  batch.targets_ = targets_;
  batch.seed_ = seed_;
  batch.first_candidate_ = candidates_;
  batch.candidates_ = static_cast<std::size_t>(options_.batch);
  candidates_ += batch.candidates_;
  return batch;
}

int GraphBuilder::join(Batch batch, const CollisionChecker& checker, WorkMeter& work) {
  work.merge(batch.work_);
  std::vector<NodeId> added;
  std::vector<Joint> joints;
  for (auto& view : batch.views_) {
    if (graph_->has_similar(view, options_.similarity)) continue;
    added.push_back(graph_->add(std::move(view)));
    propose_joints(added.back(), joints, work);
  }
  check_joints(joints, checker, work);
  for (const auto& joint : joints) {
    if (joint.free) connect(joint);
  }
  // A view that no motion reaches is of no use.
  int stayed = 0;
  for (const NodeId id : added) {
    if (graph_->node(id).edges.empty() && !options_.keep_unconnected) {
      graph_->remove(id);
    } else {
      ++stayed;
    }
  }
  idle_batches_ = stayed > 0 ? 0 : idle_batches_ + 1;
  return stayed;
}

bool GraphBuilder::resting() const {
  return targets_.empty() || graph_->node_count() >= options_.max_nodes ||
         idle_batches_ >= options_.max_idle_batches;
}

void GraphBuilder::Batch::run() {
  std::vector<std::optional<ViewPose>> found(candidates_);
  std::vector<WorkMeter> meters(candidates_);
  tbb::parallel_for(std::size_t{0}, candidates_, [&](std::size_t i) {
    Rng rng(seed_, "view candidate", first_candidate_ + i);
    found[i] = sampler_->sample(*map_, *checker_, targets_, rng, meters[i]);
  });
  for (std::size_t i = 0; i < candidates_; ++i) {
    work_.merge(meters[i]);
    if (found[i]) views_.push_back(std::move(*found[i]));
  }
}

void GraphBuilder::propose_joints(NodeId id, std::vector<Joint>& joints, WorkMeter& work) const {
  const Configuration& q = graph_->node(id).view.q;
  work.add(Work::neighbor_search);
  const auto k = static_cast<std::size_t>(options_.neighbors);
  bool start_proposed = false;
  for (const auto& neighbor : graph_->nearest(q, k, options_.max_edge_distance_rad, id)) {
    joints.push_back({id, neighbor.id});
    start_proposed |= neighbor.id == start_;
  }
  const bool start_is_lonely =
      start_ != kNoNode && !graph_->node(start_).removed && open_ways(start_) < options_.neighbors;
  if (start_is_lonely && !start_proposed &&
      graph_->distance_rad(id, start_) <= options_.max_start_distance_rad) {
    joints.push_back({id, start_});
  }
}

void GraphBuilder::check_joints(std::vector<Joint>& joints, const CollisionChecker& checker,
                                WorkMeter& work) const {
  tbb::parallel_for(std::size_t{0}, joints.size(), [&](std::size_t i) {
    Joint& joint = joints[i];
    joint.free = checker.edge_free(begin_of(joint), end_of(joint), &joint.states_checked);
  });
  for (const auto& joint : joints) {
    work.add(Work::state_check, joint.states_checked);
    if (options_.on_edge) options_.on_edge(begin_of(joint), end_of(joint), joint.free);
  }
}

const Configuration& GraphBuilder::begin_of(const Joint& joint) const {
  return graph_->node(joint.a).view.q;
}

Configuration GraphBuilder::end_of(const Joint& joint) const {
  return robot_->endless().nearest(graph_->node(joint.b).view.q, begin_of(joint));
}

void GraphBuilder::connect(const Joint& joint) {
  graph_->connect(joint.a, joint.b,
                  straight_motion_time(begin_of(joint), end_of(joint), *robot_, options_.sharp));
}

}  // namespace canopeer
