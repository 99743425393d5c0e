#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/compute_cost.h"
#include "canopeer/map/frontier.h"
#include "canopeer/search/view_path.h"
#include "canopeer/viewgraph/segment_frame.h"

namespace canopeer {

/// What a search for a path of views may look at. The pointers outlive the call.
struct PathQuery {
  ViewGraph* graph = nullptr;
  NodeId at{};  ///< where the arm is
  const VoxelMap* map = nullptr;
  const FrontierTargets* targets = nullptr;  ///< of the map, in the sampling region
  const SegmentFrame* segment = nullptr;
  const RobotModel* robot = nullptr;
  const CostTable* costs = nullptr;
  std::uint64_t seed = 1;
  double time_left_s = 0.0;  ///< of the segment; infinite: no limit
};

/// A search over the view graph, in place of Algorithm 1 of [Zaenker23] in the same planner.
/// Deterministic; one for each planner, used by one thread.
class PathFinder {
 public:
  virtual ~PathFinder() = default;
  /// Forgets the last segment.
  virtual void begin_segment() {}
  /// The path to follow now; empty: none. Its nodes are not visited yet.
  [[nodiscard]] virtual ViewPath find(const PathQuery& query, WorkMeter& work) = 0;
  /// Asked before each step of the path found last, but its first: it is still worth following.
  [[nodiscard]] virtual bool keeps(const PathQuery& /*query*/, WorkMeter& /*work*/) { return true; }
  /// After an empty path: there is nothing left to look for here.
  [[nodiscard]] virtual bool done() const { return false; }

  /// What later calls depend on, as bytes.
  [[nodiscard]] virtual std::string state() const { return {}; }
  [[nodiscard]] virtual Expected<void> restore(std::string_view /*state*/) { return {}; }
};

/// Makes one for each planner.
using PathFinderFactory = std::function<std::unique_ptr<PathFinder>()>;

}  // namespace canopeer
