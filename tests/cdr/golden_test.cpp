#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

#include "all_messages.h"
#include "canopeer/base/atomic_file.h"
#include "canopeer/cdr/cdr.h"

// golden/ holds what rclpy of ROS 2 Humble makes of the messages below, serialised by each of its
// two middlewares.

namespace canopeer::ros {
namespace {

using Trajectory = control_msgs::FollowJointTrajectory;

constexpr builtin_interfaces::Time kStamp{1700000000, 123456789};

Payload golden(const std::string& middleware, const std::string& name) {
  const auto bytes = read_file(std::filesystem::path(CANOPEER_SOURCE_DIR) / "tests/cdr/golden" /
                               ("humble_" + middleware) / (name + ".bin"));
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? Payload(bytes->begin(), bytes->end()) : Payload();
}

/// Of rmw_cyclonedds: the same octets. Of rmw_fastrtps: octets that pad are whatever was in its
/// buffer, and up to 44 octets follow, because it sizes the buffer as if every member needed the
/// most padding.
template <class Message>
void expect_golden(const std::string& name, const Message& message) {
  SCOPED_TRACE(name);
  const Payload ours = to_cdr(message);
  const Payload cyclone = golden("cyclonedds", name);
  EXPECT_EQ(ours, cyclone);
  const Payload fast = golden("fastrtps", name);
  ASSERT_GE(fast.size(), ours.size());
  EXPECT_LE(fast.size(), ours.size() + 44);
  for (const Payload& theirs : {cyclone, fast}) {
    const auto read = from_cdr<Message>(theirs);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_cdr(*read), ours);
  }
}

std::vector<std::uint8_t> counting(int size) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

UUID counting_id() {
  UUID id;
  std::iota(id.uuid.begin(), id.uuid.end(), std::uint8_t{0});
  return id;
}

trajectory_msgs::JointTrajectory two_points() {
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = {"j1", "joint_two"};
  trajectory.points.resize(2);
  trajectory.points[0].positions = {1.0, 2.0};
  trajectory.points[0].velocities = {0.5};
  trajectory.points[0].time_from_start = {1, 5};
  trajectory.points[1].positions = {3.0, 4.0};
  trajectory.points[1].effort = {7.0, 8.0};
  trajectory.points[1].time_from_start = {2, 0};
  return trajectory;
}

TEST(CdrGolden, Images) {
  for (const std::string frame : {"abc", "abcd", ""}) {
    sensor_msgs::Image image;
    image.header = {kStamp, frame};
    image.height = 2;
    image.width = 3;
    image.encoding = "rgb8";
    image.step = 9;
    image.data = counting(18);
    expect_golden("Image_" + (frame.empty() ? "empty" : frame), image);
  }
}

TEST(CdrGolden, CameraInfo) {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "cam";
  info.height = 480;
  info.width = 640;
  info.distortion_model = "plumb_bob";
  info.d = {0.1, -0.2, 0.0, 0.0, 0.5};
  info.k = {615.5, 0.0, 320.25, 0.0, 615.75, 240.5, 0.0, 0.0, 1.0};
  info.binning_x = 2;
  info.roi.x_offset = 7;
  info.roi.do_rectify = true;
  expect_golden("CameraInfo", info);
}

TEST(CdrGolden, JointState) {
  sensor_msgs::JointState state;
  state.header.stamp = kStamp;
  state.name = {"a", "bb", "ccc", ""};
  state.position = {1.5, -2.5, 3.25, 0.0};
  state.effort = {9.0};
  expect_golden("JointState", state);
}

TEST(CdrGolden, Transforms) {
  tf2_msgs::TFMessage tf;
  tf.transforms.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    tf.transforms[i].header.frame_id.assign(i, 'p');
    tf.transforms[i].child_frame_id.assign(i + 2, 'c');
    tf.transforms[i].transform.translation.x = 1.0 + static_cast<double>(i);
    tf.transforms[i].transform.rotation.w = 0.5;
  }
  expect_golden("TFMessage", tf);
}

TEST(CdrGolden, PointCloud) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.height = 1;
  cloud.width = 2;
  cloud.fields = {{"x", 0, PointField::FLOAT32, 1}, {"intensity", 4, PointField::UINT8, 3}};
  cloud.point_step = 8;
  cloud.row_step = 16;
  cloud.data = counting(16);
  cloud.is_dense = true;
  expect_golden("PointCloud2", cloud);
}

TEST(CdrGolden, JointTrajectory) { expect_golden("JointTrajectory", two_points()); }

TEST(CdrGolden, Markers) {
  using visualization_msgs::Marker;
  Marker marker;
  marker.header.frame_id = "base_link";
  marker.ns = "fruit";
  marker.id = -3;
  marker.type = Marker::SPHERE;
  marker.pose.position.z = 2.5;
  marker.scale.x = 0.1;
  marker.color = {1.0F, 0.5F, 0.25F, 0.75F};
  marker.lifetime.sec = 4;
  marker.frame_locked = true;
  marker.points = {{1.0, 2.0, 3.0}};
  marker.colors = {{0.0F, 0.0F, 0.0F, 1.0F}};
  marker.text = "apple";
  marker.mesh_use_embedded_materials = true;
  expect_golden("MarkerArray", visualization_msgs::MarkerArray{{marker, Marker()}});
}

TEST(CdrGolden, TextsAndServices) {
  expect_golden("String", std_msgs::String{"h\xC3\xA4llo"});
  expect_golden("Trigger_Request", std_srvs::Trigger::Request());
  expect_golden("Trigger_Response", std_srvs::Trigger::Response{true, "ok then"});
}

TEST(CdrGolden, SendingAGoal) {
  SendGoal<Trajectory>::Request request;
  request.goal_id = counting_id();
  request.goal.trajectory = two_points();
  request.goal.path_tolerance = {{"j1", 0.1, 0.2, 0.3}};
  request.goal.component_path_tolerance = {{"jj", 4, 1.0, 0.0, 0.0}};
  request.goal.goal_time_tolerance.sec = 3;
  expect_golden("FJT_SendGoal_Request", request);
  expect_golden("FJT_SendGoal_Response", SendGoal<Trajectory>::Response{true, kStamp});
}

TEST(CdrGolden, ResultAndFeedback) {
  expect_golden("FJT_GetResult_Request", GetResult<Trajectory>::Request{counting_id()});
  GetResult<Trajectory>::Response response;
  response.status = action_msgs::GoalStatus::STATUS_SUCCEEDED;
  response.result = {Trajectory::Result::GOAL_TOLERANCE_VIOLATED, "no"};
  expect_golden("FJT_GetResult_Response", response);

  FeedbackMessage<Trajectory> feedback;
  feedback.goal_id = counting_id();
  feedback.feedback.joint_names = {"j1"};
  feedback.feedback.actual.positions = {0.25};
  feedback.feedback.desired.time_from_start.sec = 9;
  expect_golden("FJT_FeedbackMessage", feedback);
}

TEST(CdrGolden, StatusAndCancelling) {
  const action_msgs::GoalInfo goal{counting_id(), kStamp};
  const action_msgs::GoalStatus status{goal, action_msgs::GoalStatus::STATUS_EXECUTING};
  expect_golden("GoalStatusArray", action_msgs::GoalStatusArray{{status, status}});
  expect_golden("CancelGoal_Request", action_msgs::CancelGoal::Request{{counting_id(), {}}});
  expect_golden("CancelGoal_Response",
                action_msgs::CancelGoal::Response{
                    action_msgs::CancelGoal::Response::ERROR_UNKNOWN_GOAL_ID, {goal}});
}

}  // namespace
}  // namespace canopeer::ros
