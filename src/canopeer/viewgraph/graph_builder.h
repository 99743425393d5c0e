#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/robot/joint_path.h"
#include "canopeer/viewgraph/view_graph.h"
#include "canopeer/viewgraph/view_sampler.h"

namespace canopeer {

/// Which views become nodes, and which nodes are joined.
struct GraphBuilderOptions {
  ViewSamplerOptions sampler;
  SimilarityLimits similarity;
  TargetShares shares;
  int neighbors = 5;                     ///< k: nearest neighbours a node is joined to
  double max_edge_distance_rad = 2.0;    ///< Σ|Δq| of an edge at most
  double max_start_distance_rad = 10.0;  ///< the same for edges of the camera's node
  int max_nodes = 2000;  ///< the builder rests at this many nodes until targets change
  int batch = 64;        ///< candidates sampled together (in parallel) before they are joined
  int max_idle_batches =
      40;  ///< batches in a row without a new node, then rest until targets change
  bool keep_unconnected = false;  ///< views that join nothing stay, as in the published code
  /// Told of every motion between two views that was proposed as an edge, and whether it was free.
  /// For measurements. Called in the thread that joins.
  std::function<void(const Configuration& from, const Configuration& to, bool free)> on_edge{};
  /// Edges cost what their motions take under it; nothing: as fast as the joints can.
  std::optional<ImageMotionLimit> sharp{};
};

/// Grows a view graph batch by batch ([Zaenker23], section III-C). It samples view poses and skips
/// those too similar to present ones. It joins each to its nearest neighbours by collision-free
/// straight joint motions, and drops those that join nothing. Candidate i always draws from random
/// stream i, so the graph does not depend on the number of threads.
class GraphBuilder {
 public:
  /// Keeps pointers to all but the options; they must outlive the builder.
  GraphBuilder(ViewGraph& graph, const SegmentFrame& frame, const RobotModel& robot,
               const ArmIk& ik, const GraphBuilderOptions& options, std::uint64_t seed);

  /// New frontiers, re-extracted after a frame: a resting builder wakes. Views whose ROI target is
  /// no frontier any more stop facing a ROI. Where a kind is full, unvisited views whose target is
  /// no frontier any more make room, except those in `keep`.
  void set_targets(const VoxelMap& map, const FrontierTargets& targets,
                   const std::vector<NodeId>& keep);

  /// Puts the arm's present configuration in as a visited node and joins it to its neighbours.
  NodeId add_start(const Configuration& q, const CollisionChecker& checker,
                   const Pose& T_world_camera, WorkMeter& work);

  /// Makes `id` the node the arm stands at. When it leads to fewer than k unvisited views it is
  /// joined to the nearest ones within `max_start_distance_rad`, and candidates that come later are
  /// too.
  void join_start(NodeId id, const CollisionChecker& checker, WorkMeter& work);

  /// A number of candidates to be sampled together. run() needs nothing of the graph. It may go on
  /// in another thread, but the map must not change and the builder must not end meanwhile.
  class Batch {
   public:
    void run();

   private:
    friend class GraphBuilder;
    const ViewSampler* sampler_ = nullptr;
    const VoxelMap* map_ = nullptr;
    const CollisionChecker* checker_ = nullptr;
    TargetSampler targets_;
    std::uint64_t seed_ = 0;
    std::uint64_t first_candidate_ = 0;
    std::size_t candidates_ = 0;
    std::vector<ViewPose> views_;
    WorkMeter work_;
  };
  [[nodiscard]] Batch next_batch(const VoxelMap& map, const CollisionChecker& checker);
  /// Puts the views of a batch that has run into the graph. Returns the number that stayed.
  int join(Batch batch, const CollisionChecker& checker, WorkMeter& work);

  /// One batch of candidates: next_batch, run, join.
  int grow(const VoxelMap& map, const CollisionChecker& checker, WorkMeter& work);

  /// Nothing to do until targets change.
  [[nodiscard]] bool resting() const;

  /// What has changed since it was made; the graph writes itself.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(candidates_, targets_, idle_batches_, start_);
  }

 private:
  struct Joint {
    NodeId a{};
    NodeId b{};
    bool free = false;
    int states_checked = 0;
  };
  void propose_joints(NodeId id, std::vector<Joint>& joints, WorkMeter& work) const;
  void check_joints(std::vector<Joint>& joints, const CollisionChecker& checker,
                    WorkMeter& work) const;
  void connect(const Joint& joint);
  /// The motion along it, the shorter way round.
  [[nodiscard]] const Configuration& begin_of(const Joint& joint) const;
  [[nodiscard]] Configuration end_of(const Joint& joint) const;
  /// Edges to views not taken yet.
  [[nodiscard]] int open_ways(NodeId id) const;
  /// A kind has its share of max_nodes.
  [[nodiscard]] bool full(TargetKind kind) const;

  ViewGraph* graph_;
  const RobotModel* robot_;
  ViewSampler sampler_;
  GraphBuilderOptions options_;
  std::uint64_t seed_;
  std::uint64_t candidates_ = 0;
  TargetSampler targets_;
  int idle_batches_ = 0;
  NodeId start_;
};

}  // namespace canopeer
