#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/planner/vmp/vmp_planner.h"
#include "canopeer/search/path_search.h"
#include "planner_fixture.h"

// The search on the graph and map of a real segment, recomputed from scratch voxel by voxel.

namespace canopeer {
namespace {

using Cells = std::set<std::tuple<int, int, int>>;

/// The unknown voxels the fan's rays cross before the first occupied one, or until they crossed
/// enough; nothing shared with the view cast but the walk along a ray.
Cells visible_by_definition(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan) {
  Cells cells;
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column < fan.columns; ++column) {
      const double x = std::tan(fan.fov_x_rad / 2) * (2.0 * column / (fan.columns - 1) - 1.0);
      const double y = std::tan(fan.fov_y_rad / 2) * (2.0 * row / (fan.rows - 1) - 1.0);
      const Vec3 end = T_world_camera * (fan.depth_m * Vec3(x, y, 1.0));
      const Vec3 from = T_world_camera.translation();
      const double voxels = VoxelWalk(from, end, map.resolution_m()).steps + 1.0;
      const double limit = std::ceil(voxels * fan.max_unknown_m / (end - from).norm());
      int unknown = 0;
      walk_voxels(from, end, map.resolution_m(), [&](const VoxelIndex& v) {
        const Occupancy state = map.occupancy(v);
        if (state == Occupancy::unknown) cells.emplace(v.x(), v.y(), v.z());
        unknown += state == Occupancy::unknown ? 1 : 0;
        return state != Occupancy::occupied && unknown < limit;
      });
    }
  }
  return cells;
}

TEST(SearchOracle, UtilitiesAndVisibleSetsAlongThePathAreThoseOfTheDefinition) {
  PlannerOptions options;
  test::PlannerFixture run(std::make_unique<VmpPlanner>(options.vmp));
  run.planner->grow(0.3, run.work);
  // A few views on, so that most visible sets were kept from one frame to the next and some not.
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(run.take_view());
    run.planner->grow(0.1, run.work);
  }
  const auto& vmp = dynamic_cast<const VmpPlanner&>(*run.planner);
  ViewGraph graph = vmp.graph();
  NodeId start{};
  for (std::size_t i = 0; i < graph.id_count(); ++i) {
    const auto id = static_cast<NodeId>(i);
    if (!graph.node(id).removed && joint_distance(graph.node(id).view.q, run.q) < 1e-9) start = id;
  }
  const PathSearchOptions& search = options.vmp.path_search;
  const VoxelMap& map = run.world.perception.map();
  WorkMeter work;
  const ViewPath path = search_path(graph, start, map, search, work);
  ASSERT_GE(path.steps.size(), 2U);

  Cells all;
  double length_s = 0.0;
  int roi_views = 0;
  NodeId at = start;
  for (const auto& step : path.steps) {
    const ViewNode& node = graph.node(step.node);
    const Cells cells = visible_by_definition(map, node.view.T_world_camera, search.fan);
    ASSERT_EQ(static_cast<std::int64_t>(cells.size()), node.cast->unknown.count());
    for (const auto& [x, y, z] : cells) {
      ASSERT_TRUE(node.cast->unknown.contains(VoxelIndex(x, y, z)));
    }
    const std::size_t before = all.size();
    all.insert(cells.begin(), cells.end());
    EXPECT_EQ(step.new_unknown, static_cast<std::int64_t>(all.size() - before));
    length_s += graph.edge_time(at, step.node).value() + search.observe_s;
    roi_views += node.view.kind == TargetKind::roi ? 1 : 0;
    at = step.node;
  }
  const double utility = static_cast<double>(all.size()) / length_s * (roi_views + 1) /
                         (static_cast<double>(path.steps.size()) + 1.0);
  EXPECT_NEAR(path.utility, utility, 1e-9 * utility);
}

}  // namespace
}  // namespace canopeer
