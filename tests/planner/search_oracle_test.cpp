#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/planner/vmp/vmp_planner.h"
#include "canopeer/search/path_search.h"
#include "canopeer/search/path_tree.h"
#include "canopeer/search/random_walk.h"
#include "canopeer/search/view_casts.h"
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

/// A segment some views on, so that most visible sets were kept from one frame to the next.
class SearchOracle : public ::testing::Test {
 protected:
  SearchOracle() : run_(std::make_unique<VmpPlanner>(VmpOptions{})) {
    run_.planner->grow(0.3, run_.work);
    for (int i = 0; i < 4; ++i) {
      EXPECT_TRUE(run_.take_view());
      run_.planner->grow(0.1, run_.work);
    }
    graph_ = dynamic_cast<const VmpPlanner&>(*run_.planner).graph();
    for (std::size_t i = 0; i < graph_.id_count(); ++i) {
      const auto id = static_cast<NodeId>(i);
      const ViewNode& node = graph_.node(id);
      if (!node.removed && joint_distance(node.view.q, run_.q) < 1e-9) start_ = id;
    }
  }

  /// Visible sets, what each view adds, and U, from scratch along start → steps. Returns U.
  double check_along(const std::vector<PathStep>& steps) {
    Cells all;
    double length_s = 0.0;
    int roi_views = 0;
    NodeId at = start_;
    for (const auto& step : steps) {
      const ViewNode& node = graph_.node(step.node);
      const Cells cells = visible_by_definition(map(), node.view.T_world_camera, search_.fan);
      EXPECT_EQ(static_cast<std::int64_t>(cells.size()), node.cast->unknown.count());
      for (const auto& [x, y, z] : cells) {
        EXPECT_TRUE(node.cast->unknown.contains(VoxelIndex(x, y, z)));
      }
      const std::size_t before = all.size();
      all.insert(cells.begin(), cells.end());
      EXPECT_EQ(step.new_unknown, static_cast<std::int64_t>(all.size() - before));
      length_s += graph_.edge_time(at, step.node).value() + search_.observe_s;
      roi_views += node.view.kind == TargetKind::roi ? 1 : 0;
      at = step.node;
    }
    return static_cast<double>(all.size()) / length_s * (roi_views + 1) /
           (static_cast<double>(steps.size()) + 1.0);
  }
  [[nodiscard]] const VoxelMap& map() const { return run_.world.perception.map(); }

  test::PlannerFixture run_;
  ViewGraph graph_;
  NodeId start_{};
  PathSearchOptions search_;
};

TEST_F(SearchOracle, UtilityAndVisibleSetsAlongTheChosenPathAreThoseOfTheDefinition) {
  WorkMeter work;
  const ViewPath path = search_path(graph_, start_, map(), search_, work);
  ASSERT_FALSE(path.steps.empty());
  EXPECT_NEAR(path.utility, check_along(path.steps), 1e-9 * path.utility);
}

TEST_F(SearchOracle, TheSameAlongAnyLongPath) {
  Rng rng(5);
  WorkMeter work;
  const ViewPath walk = random_walk(graph_, start_, 8, rng);
  ASSERT_GE(walk.steps.size(), 5U);
  PathTree tree(graph_, start_);
  NodeId at = start_;
  for (const auto& step : walk.steps) {
    ensure_casts(graph_, {step.node}, map(), search_.fan, work);
    tree.expand(at);
    tree.attach(step.node, step.time_s + search_.observe_s);
    at = step.node;
  }
  EXPECT_NEAR(tree.utility(at), check_along(tree.path_to(at).steps), 1e-9 * tree.utility(at));
}

}  // namespace
}  // namespace canopeer
