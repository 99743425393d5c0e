#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "canopeer/ros2/out/frame_teller.h"
#include "canopeer/ros2/out/link_transforms.h"
#include "canopeer/ros2/out/message_parts.h"
#include "canopeer/ros2/out/robot_description_text.h"
#include "heard.h"
#include "support/planning_fixture.h"

namespace canopeer::ros {
namespace {

using geometry_msgs::TransformStamped;
using testing_support::eventually;
using testing_support::make_node;

RobotPlace a_place() { return {test::test_robot().home("side_1"), {1.0, 0.5}}; }

std::map<std::string, Pose> parents_of(const std::vector<TransformStamped>& frames,
                                       std::map<std::string, std::string>& parents) {
  std::map<std::string, Pose> T;
  for (const auto& frame : frames) {
    const auto& [t, r] = frame.transform;
    Pose pose = Pose::Identity();
    pose.translation() = Vec3(t.x, t.y, t.z);
    pose.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix();
    T[frame.child_frame_id] = pose;
    parents[frame.child_frame_id] = frame.header.frame_id;
  }
  return T;
}

TEST(MissingFrames, AreAllWhenNobodyTellsAny) {
  const RobotModel& robot = test::test_robot();
  const auto frames = missing_frames(robot, a_place(), "map", {}, 1);
  EXPECT_EQ(frames.size(), robot.links().size());
}

TEST(MissingFrames, AreThoseAboveAnArmWhoseDriverTellsTheRest) {
  const RobotModel& robot = test::test_robot();
  OthersFrames::Frames others;
  for (const auto& frame : link_transforms(robot, a_place().q, a_place().trolley, "map", 1)) {
    if (robot.arm_joints_before(robot.link_index(frame.child_frame_id)) > 0) {
      others[frame.child_frame_id].parent = frame.header.frame_id;
    }
  }
  ASSERT_FALSE(others.empty());
  const auto frames = missing_frames(robot, a_place(), "map", others, 1);
  EXPECT_EQ(frames.size() + others.size(), robot.links().size());
  for (const auto& frame : frames) EXPECT_FALSE(others.contains(frame.child_frame_id));
}

TEST(MissingFrames, PutTheTreeOfOthersWhereTheMapIs) {
  // A driver that knows nothing of a trolley: its world is 0.2 m below the base link.
  const RobotModel& robot = test::test_robot();
  OthersFrames::Frames others;
  others["base_link"].parent = "world";
  others["base_link"].T_parent_child.translation() = Vec3(0.0, 0.0, 0.2);
  const auto frames = missing_frames(robot, a_place(), "map", others, 1);
  std::map<std::string, std::string> parents;
  const auto T = parents_of(frames, parents);
  EXPECT_FALSE(T.contains("base_link"));
  ASSERT_TRUE(T.contains("world"));
  EXPECT_EQ(parents["world"], "map");
  const Pose expected = robot.T_world_base(a_place().trolley);
  EXPECT_TRUE((T.at("world") * others["base_link"].T_parent_child).isApprox(expected, 1e-9));
}

TEST(MissingFrames, AreNoneOfTheMapWhenSomebodyTellsIt) {
  OthersFrames::Frames others;
  others["rails_link"].parent = "map";
  for (const auto& frame : missing_frames(test::test_robot(), a_place(), "map", others, 1)) {
    EXPECT_NE(frame.header.frame_id, "map");
  }
}

TEST(MissingFrames, EndInATreeThatBitesItsTail) {
  OthersFrames::Frames others;
  others["base_link"].parent = "a";
  others["a"].parent = "b";
  others["b"].parent = "base_link";
  EXPECT_FALSE(missing_frames(test::test_robot(), a_place(), "map", others, 1).empty());
}

TEST(RobotDescriptionText, MakesNamesOfMeshesWhole) {
  EXPECT_EQ(
      with_whole_file_names(
          R"(<a><mesh filename="arm.stl"/><mesh filename='package://x/y.dae'/></a>)", "/robots/ur"),
      R"(<a><mesh filename="file:///robots/ur/arm.stl"/>)"
      R"(<mesh filename='package://x/y.dae'/></a>)");
  EXPECT_EQ(with_whole_file_names("<mesh filename=\"cut", "/r"), "<mesh filename=\"cut");
  const auto text = robot_description_text(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml");
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_NE(text->find("<robot name=\"ur5e_trolley\">"), std::string::npos);
}

class FrameTellerTest : public ::testing::Test {
 protected:
  std::unique_ptr<FrameTeller> teller() {
    FrameTeller::Parts parts{*node_, clock_, test::test_robot(),
                             [] { return std::optional(a_place()); }};
    parts.description = "<robot name=\"ours\"/>";
    parts.listen_first = std::chrono::milliseconds(0);
    return must(FrameTeller::make(std::move(parts), {}));
  }
  std::unique_ptr<Node> node_ = make_node("canopeer");
  std::unique_ptr<Node> other_ = make_node("robot_state_publisher");
  RosClock clock_;
};

bool tells(const tf2_msgs::TFMessage& message, const std::string& child) {
  for (const auto& frame : message.transforms) {
    if (frame.child_frame_id == child) return true;
  }
  return false;
}

TEST_F(FrameTellerTest, FallsSilentWhereOthersSpeak) {
  const Heard<tf2_msgs::TFMessage> tf(*other_, "/tf", kTfQos);
  const auto frames = teller();
  ASSERT_TRUE(tf.comes_to([](const auto& m) { return tells(m, "base_link"); }));

  const auto fixed = must(other_->advertise<tf2_msgs::TFMessage>("/tf_static", kLatchedQos));
  tf2_msgs::TFMessage message;
  message.transforms.push_back({header_of("world", 0), "base_link", {}});
  fixed.publish(message);
  EXPECT_TRUE(
      tf.comes_to([](const auto& m) { return !tells(m, "base_link") && tells(m, "world"); }));
}

TEST_F(FrameTellerTest, TellsTheDescriptionUntilAnotherDoes) {
  const Heard<std_msgs::String> description(*other_, "/robot_description");
  const auto frames = teller();
  ASSERT_TRUE(
      description.comes_to([](const auto& text) { return text.data == "<robot name=\"ours\"/>"; }));
  const auto theirs = must(other_->advertise<std_msgs::String>("/robot_description", kLatchedQos));
  const auto ours_are_there = [&] {
    const auto publishers = other_->publishers_of("/robot_description");
    return std::any_of(publishers.begin(), publishers.end(), [&](const Endpoint& e) {
      return participant_of(e.guid) == node_->participant().id();
    });
  };
  EXPECT_TRUE(eventually([&] { return !ours_are_there(); }));
}

}  // namespace
}  // namespace canopeer::ros
