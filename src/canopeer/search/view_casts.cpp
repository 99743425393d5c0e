#include "canopeer/search/view_casts.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace canopeer {

void ensure_casts(ViewGraph& graph, const std::vector<NodeId>& nodes, const VoxelMap& map,
                  const ViewFan& fan, WorkMeter& work, const CastFunction& cast) {
  std::vector<NodeId> missing;
  for (const NodeId id : nodes) {
    if (!graph.node(id).cast) missing.push_back(id);
  }
  work.add(Work::view_cast, static_cast<std::int64_t>(missing.size()));
  const auto cast_one = [&](std::size_t i) {
    ViewNode& node = graph.node(missing[i]);
    const Pose& T = node.view.T_world_camera;
    node.cast = cast ? cast(map, T) : cast_view(map, T, fan);
  };
  if (tbb::this_task_arena::max_concurrency() == 1) {  // a task costs more than a microsecond
    for (std::size_t i = 0; i < missing.size(); ++i) cast_one(i);
  } else {
    tbb::parallel_for(std::size_t{0}, missing.size(), cast_one);
  }
}

}  // namespace canopeer
