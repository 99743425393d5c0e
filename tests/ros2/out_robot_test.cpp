#include <gtest/gtest.h>

#include <map>

#include "canopeer/ros2/out/link_transforms.h"
#include "support/planning_fixture.h"

namespace canopeer::ros {
namespace {

TEST(LinkTransforms, ChainUpToTheCamera) {
  const RobotModel& robot = test::test_robot();
  const Configuration q = robot.home("side_2");
  const TrolleyState trolley{1.2, 0.3};
  const auto frames = link_transforms(robot, q, trolley, "map", 5);
  EXPECT_EQ(frames.size(), robot.links().size());
  std::map<std::string, geometry_msgs::TransformStamped> by_child;
  for (const auto& frame : frames) by_child[frame.child_frame_id] = frame;
  EXPECT_EQ(by_child.size(), frames.size()) << "each link has one parent";

  Pose T_world_camera = Pose::Identity();
  for (std::string at = robot.setup().camera_frame; at != "map";) {
    const auto& frame = by_child.at(at);
    Pose T = Pose::Identity();
    const auto& [translation, rotation] = frame.transform;
    T.translation() = Vec3(translation.x, translation.y, translation.z);
    T.linear() =
        Eigen::Quaterniond(rotation.w, rotation.x, rotation.y, rotation.z).toRotationMatrix();
    T_world_camera = T * T_world_camera;
    at = frame.header.frame_id;
  }
  const Pose expected = robot.T_world_base(trolley) * robot.T_base_camera(q);
  EXPECT_TRUE(T_world_camera.isApprox(expected, 1e-9));
}

}  // namespace
}  // namespace canopeer::ros
