#include <gtest/gtest.h>

#include "canopeer/ros2/out/frustum_marker.h"
#include "canopeer/ros2/out/message_parts.h"
#include "canopeer/ros2/out/plan_markers.h"

namespace canopeer::ros {
namespace {

using visualization_msgs::Marker;

const std_msgs::Header kInMap = header_of("map", 7);

PlanSketch::View view_at(double x, std::int32_t id, bool visited = false) {
  PlanSketch::View view;
  view.T_world_camera = look_at({x, 0.0, 0.0}, {x, 1.0, 0.0});
  view.kind = TargetKind::roi;
  view.visited = visited;
  view.id = id;
  return view;
}

PlanSketch three_views() {
  PlanSketch sketch;
  sketch.views = {view_at(0.0, 2, true), view_at(1.0, 5), view_at(2.0, 9)};
  sketch.edges = {{2, 5, 1.0}, {5, 9, 2.0}, {5, 77, 1.0}};
  sketch.path = {5, 9};
  sketch.at = 2;
  return sketch;
}

TEST(PlanMarkers, ShowViewsEdgesAndPath) {
  const auto markers = plan_markers(three_views(), kInMap).markers;
  ASSERT_EQ(markers.size(), 4u);
  EXPECT_EQ(markers[0].ns, "views");
  ASSERT_EQ(markers[0].points.size(), 3u);
  ASSERT_EQ(markers[0].colors.size(), 3u);
  EXPECT_NE(markers[0].colors[0].r, markers[0].colors[1].r);  // visited
  EXPECT_EQ(markers[1].ns, "axes");
  ASSERT_EQ(markers[1].points.size(), 6u);
  EXPECT_NEAR(markers[1].points[1].y, 0.04, 1e-12);
  EXPECT_EQ(markers[2].ns, "edges");
  EXPECT_EQ(markers[2].points.size(), 4u);  // no edge to a view that is not there
  EXPECT_EQ(markers[3].ns, "path");
  ASSERT_EQ(markers[3].points.size(), 3u);
  EXPECT_DOUBLE_EQ(markers[3].points[0].x, 0.0);
  EXPECT_DOUBLE_EQ(markers[3].points[2].x, 2.0);
  for (const Marker& marker : markers) {
    EXPECT_EQ(marker.action, Marker::ADD);
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_GT(marker.scale.x, 0.0);
  }
}

TEST(PlanMarkers, DeleteWhatIsEmpty) {
  for (const Marker& marker : plan_markers({}, kInMap).markers) {
    EXPECT_EQ(marker.action, Marker::DELETE) << marker.ns;
  }
}

TEST(PlanPath, BeginsWhereTheArmStands) {
  const auto path = plan_path(three_views(), kInMap);
  ASSERT_EQ(path.poses.size(), 3u);
  EXPECT_DOUBLE_EQ(path.poses[1].pose.position.x, 1.0);
  const auto& q = path.poses[1].pose.orientation;
  const Vec3 axis = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Vec3::UnitZ();
  EXPECT_TRUE(axis.isApprox(Vec3::UnitY(), 1e-12));
}

TEST(FrustumMarker, EndsAtTheCornersOfTheImage) {
  CameraIntrinsics camera = CameraIntrinsics::from_fov(640, 480, 1.0);
  const Pose T = look_at({1.0, 2.0, 3.0}, {1.0, 3.0, 3.0});
  const Marker marker = frustum_marker(camera, T, 0.5, kInMap);
  ASSERT_EQ(marker.points.size(), 16u);
  EXPECT_NEAR(marker.points[1].x, -0.5 * std::tan(0.5), 1e-12);
  EXPECT_NEAR(marker.points[1].z, 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(marker.pose.position.z, 3.0);
}

}  // namespace
}  // namespace canopeer::ros
