// What the check says of what it hears, without a network.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "canopeer/cdr/messages/rmw_dds_common.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/ros2/check/clock_judgement.h"
#include "canopeer/ros2/check/frame_judgement.h"
#include "canopeer/ros2/check/joint_judgement.h"
#include "canopeer/ros2/check/look_around.h"
#include "canopeer/ros2/check/motion_check.h"
#include "canopeer/ros2/check/node_ear.h"
#include "canopeer/ros2/check/peer_judgement.h"
#include "canopeer/ros2/check/topic_judgement.h"

namespace canopeer::ros {
namespace {

const RobotModel& checked_robot() {
  static const RobotModel robot =
      *load_robot(std::string(CANOPEER_SOURCE_DIR) + "/robots/ur5e_trolley/robot.yaml");
  return robot;
}

/// "wrong joint names: missing: …", one a line.
std::string lines(const Findings& findings) {
  constexpr const char* kVerdicts[] = {"ok ", "notice ", "wrong "};
  std::string text;
  for (const Ros2Finding& f : findings.all()) {
    text += kVerdicts[static_cast<int>(f.verdict)] + f.what + ": " + f.text + "\n";
  }
  return text;
}

#define EXPECT_SAID(findings, part) \
  EXPECT_NE(lines(findings).find(part), std::string::npos) << lines(findings)

HeardJoints home_said() {
  HeardJoints heard;
  const Configuration q = checked_robot().home("side_1");
  for (int j = 0; j < checked_robot().dof(); ++j) {
    heard.positions[checked_robot().setup().arm_joints[static_cast<std::size_t>(j)]] = q[j];
  }
  heard.messages["/joint_states"] = 300;
  return heard;
}

Findings judged(const HeardJoints& heard, const Ros2ArmSettings& settings = {},
                const std::string& why = "") {
  Findings findings;
  judge_joint_states(checked_robot(), settings, {}, heard, 3.0, why, findings);
  return findings;
}

TEST(Ros2Check, JointStatesThatFit) {
  const Findings findings = judged(home_said());
  EXPECT_FALSE(findings.any_wrong());
  EXPECT_SAID(findings, "ok joint states: /joint_states 100 Hz");
  EXPECT_SAID(findings, "ok joint names: all 6 are said");
  EXPECT_SAID(findings, "ok joint positions");
}

TEST(Ros2Check, JointNamesThatDoNotFit) {
  HeardJoints heard = home_said();
  heard.positions["ur_elbow"] = heard.positions["elbow_joint"];
  heard.positions.erase("elbow_joint");
  EXPECT_SAID(judged(heard),
              "wrong joint names: missing: elbow_joint; said but unknown: ur_elbow: map");
  Ros2ArmSettings settings;
  settings.joint_names = {{"elbow_joint", "ur_elbow"}};
  EXPECT_FALSE(judged(heard, settings).any_wrong());
  heard.positions["gripper"] = 0.0;
  EXPECT_SAID(judged(heard, settings), "ok joint names: all 6 are said; so are others");
}

TEST(Ros2Check, JointsBeyondLimitsInDegreesOrNoNumbers) {
  HeardJoints heard = home_said();
  heard.positions["elbow_joint"] = 90.0;
  EXPECT_SAID(judged(heard), "elbow_joint is at 90.000, limits are");
  EXPECT_SAID(judged(heard), "(degrees?)");
  heard.positions["elbow_joint"] = NAN;
  EXPECT_SAID(judged(heard), "elbow_joint is no number");
}

TEST(Ros2Check, JointStatesThatAreSilentSlowOrWithoutStamps) {
  EXPECT_SAID(judged(HeardJoints(), {}, "nobody publishes it"),
              "wrong joint states: /joint_states 0 Hz: nobody publishes it");
  HeardJoints slow = home_said();
  slow.messages["/joint_states"] = 30;
  EXPECT_SAID(judged(slow), "notice joint states: /joint_states 10 Hz: slow");
  slow.without_stamp = 30;
  EXPECT_SAID(judged(slow), "have no stamp");
}

sensor_msgs::JointState elbow_said(double position) {
  sensor_msgs::JointState state;
  state.name = {"elbow_joint", std::string(257, 'x')};
  state.position = {position, 0.0};
  return state;
}

TEST(Ros2Check, PublishersThatContradictEachOther) {
  JointEar ear([] { return Stamp(1); });
  Guid driver{}, other{};
  driver[0] = 1;
  other[0] = 2;
  const auto judge = [&] {
    Findings findings;
    judge_speakers(checked_robot(), {}, {}, ear.heard(),
                   {{participant_of(driver), {"/driver"}}, {participant_of(other), {"/dreamer"}}},
                   findings);
    return findings;
  };
  ear.take("/joint_states", elbow_said(1.0), driver);
  ear.take("/joint_states", elbow_said(1.01), other);
  EXPECT_TRUE(judge().all().empty());
  EXPECT_EQ(ear.heard().positions.size(), 1u) << "names without end are left out";
  ear.take("/joint_states", elbow_said(-1.5), other);
  EXPECT_SAID(judge(),
              "wrong joint states: elbow_joint is at -1.500 by /dreamer and at 1.000 by /driver: "
              "stop one of them");
  ear.count_from_now();
  ear.take("/joint_states", elbow_said(1.0), driver);
  EXPECT_TRUE(judge().all().empty());
}

ListenedTopic depth_topic() {
  return {"depth", "ros2.camera.depth", "/depth", "sensor_msgs/msg/Image", false, 90, "16UC1",
          614400};
}

Endpoint publisher(bool reliable, const std::string& type = "sensor_msgs::msg::dds_::Image_") {
  Endpoint endpoint;
  endpoint.writer = true;
  endpoint.topic = "rt/depth";
  endpoint.type = type;
  endpoint.qos.reliable = reliable;
  return endpoint;
}

TEST(Ros2Check, Topics) {
  const auto judge = [](const ListenedTopic& topic, const std::vector<Endpoint>& publishers,
                        const std::vector<std::string>& others = {}) {
    Findings findings;
    judge_topic(topic, publishers, others, 3.0, findings);
    return findings;
  };
  EXPECT_SAID(judge(depth_topic(), {publisher(false)}),
              "ok depth: /depth: 30.0 Hz, 16UC1, 600 KiB");
  EXPECT_SAID(judge(depth_topic(), {}, {"/cam/depth"}),
              "wrong depth: /depth: nobody publishes it; of its type there are: /cam/depth "
              "(ros2.camera.depth)");
  EXPECT_SAID(judge(depth_topic(), {publisher(true, "std_msgs::msg::dds_::String_")}),
              "/depth is std_msgs/msg/String, expected sensor_msgs/msg/Image");
  ListenedTopic reliable = depth_topic();
  reliable.reliable = true;
  EXPECT_SAID(judge(reliable, {publisher(false)}), "they never meet");
  Endpoint other = publisher(true);
  other.guid[0] = 1;
  EXPECT_SAID(judge(depth_topic(), {publisher(true), other}), "two drivers");
  ListenedTopic silent = depth_topic();
  silent.count = 0;
  EXPECT_SAID(judge(silent, {publisher(true)}), "wrong depth: /depth is published, but nothing");
  EXPECT_EQ(topics_of_type({publisher(true)}, "sensor_msgs/msg/Image"),
            std::vector<std::string>{"/depth"});
}

TEST(Ros2Check, ImagesLargerThanTheReceiveBuffer) {
  const auto judge = [](bool reliable, std::size_t usual) {
    ListenedTopic topic = depth_topic();
    topic.reliable = reliable;
    Findings findings;
    judge_buffers({topic}, {usual, usual}, findings);
    return findings;
  };
  EXPECT_SAID(judge(false, 4u << 20), "ok receive buffer: 4096 KiB");
  EXPECT_SAID(
      judge(false, 212992),
      "notice receive buffer: 208 KiB, images are 600 KiB: many may get lost; sudo sysctl -w "
      "net.core.rmem_default=4194304 net.core.rmem_max=4194304, or set "
      "ros2.camera.reliable to true");
  EXPECT_SAID(judge(true, 212992), "many may have to be sent again");
  const auto folder = std::filesystem::temp_directory_path() / "ros2_check_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rmem_default") << "212992\n";
  EXPECT_FALSE(receive_buffers(folder));
  std::ofstream(folder / "rmem_max") << "425984\n";
  EXPECT_EQ(receive_buffers(folder)->largest, 425984u);
  std::filesystem::remove_all(folder);
}

TEST(Ros2Check, Clocks) {
  const auto judge = [](double joints_s, double camera_s, double offset_s = 0.0) {
    Findings findings;
    judge_clocks(joints_s, camera_s, offset_s, findings);
    return findings;
  };
  EXPECT_SAID(judge(0.001, 0.04), "ok clocks: joint states are 1.0 ms old when they come in");
  EXPECT_SAID(judge(0.001, 1.3), "the camera's clock is about 1.30 s behind");
  EXPECT_SAID(judge(0.001, 1.3), "ros2.camera.time_offset_s to 1.30");
  EXPECT_FALSE(judge(0.001, 1.3, 1.27).any_wrong());
  EXPECT_SAID(judge(0.001, -0.2), "about 0.20 s ahead of");
  EXPECT_SAID(judge(0.001, -0.03), "notice clocks");
  EXPECT_SAID(judge(0.001, -0.03), "to -0.03 at least: --move measures it");
  EXPECT_SAID(judge(-0.2, -0.17), "notice clocks: joint states are 200 ms from the future");
  Findings findings;
  judge_sim_time(true, false, false, findings);
  judge_sim_time(false, true, true, findings);
  judge_sim_time(false, false, true, findings);
  EXPECT_SAID(findings, "wrong time: nobody publishes /clock");
  EXPECT_SAID(findings, "notice time: the wall's, though /clock is published");
  EXPECT_SAID(findings, "ok time: the wall's");
}

TEST(Ros2Check, Frames) {
  TimedFrame timed;
  timed.frame.intrinsics = CameraIntrinsics::from_fov(64, 48, 1.2);
  timed.frame.depth = DepthImage(64, 48, 1.0F);
  Findings findings;
  judge_frame(timed, CameraIntrinsics::from_fov(64, 48, 1.4), findings);
  EXPECT_SAID(findings, "ok frame: 64 x 48, 100 % with depth");
  EXPECT_SAID(findings,
              "notice field of view: sees 68.8 degrees across, the mission plans with "
              "80.2");
  timed.frame.depth = DepthImage(64, 48, 0.0F);
  judge_frame(timed, timed.frame.intrinsics, findings);
  EXPECT_SAID(findings, "hardly any depth");
  judge_frame(fail("no frame within 3 s"), timed.frame.intrinsics, findings);
  EXPECT_SAID(findings, "wrong frame: no frame within 3 s");
}

TEST(Ros2Check, TfAgainstTheRobotFile) {
  const Configuration q = checked_robot().home("side_1");
  const auto judge = [&](const Pose& T_base_optical, const std::string& pose) {
    TfBuffer tf;
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base_link";
    transform.child_frame_id = "optical";
    const Vec3 p = T_base_optical.translation();
    const Eigen::Quaterniond r(T_base_optical.linear());
    transform.transform.translation = {p.x(), p.y(), p.z()};
    transform.transform.rotation = {r.x(), r.y(), r.z(), r.w()};
    tf.add({{transform}}, true);
    Ros2CameraSettings settings;
    settings.pose = pose;
    Findings findings;
    judge_tf(tf, checked_robot(), q, settings, "optical", findings);
    judge_tf(tf, checked_robot(), q, settings, "lens", findings);
    return findings;
  };
  Pose T_base_camera = checked_robot().T_base_camera(q);
  EXPECT_SAID(judge(T_base_camera, "tf"), "ok tf: 'optical' in 'base_link' is 0.0 mm");
  EXPECT_SAID(judge(T_base_camera, "tf"), "wrong tf: tf has no frame 'lens'");
  T_base_camera.translation().x() += 0.02;
  EXPECT_SAID(judge(T_base_camera, "joint_states"),
              "notice tf: 'optical' in 'base_link' is 20.0 mm");
  EXPECT_SAID(judge(T_base_camera, "joint_states"), "notice tf: tf has no frame 'lens'");
}

TEST(Ros2Check, PeersAndTheirNodes) {
  NodeOptions ours;
  Findings nobody;
  judge_peers({}, {}, ours, nobody);
  EXPECT_SAID(nobody, "ok network: domain 0, loopback only");
  EXPECT_SAID(nobody, "wrong peers: nobody else is there");
  Peer peer;
  peer.id[0] = 7;
  peer.vendor = {0x01, 0x10};
  Findings findings;
  judge_peers({peer}, {{peer.id, {"/ur_driver", "/cell/camera"}}}, ours, findings);
  EXPECT_SAID(findings, "ok peer: Eclipse Cyclone DDS (rmw_cyclonedds): /cell/camera /ur_driver");
  EXPECT_FALSE(findings.any_wrong());
}

TEST(Ros2Check, AnActionServedByAMiddlewareThatIsNotUnderstood) {
  Peer peer;
  peer.id[0] = 7;
  peer.vendor = {0x01, 0x01};
  Endpoint server;
  server.guid[0] = 7;
  server.topic = "rq/arm/follow/_action/send_goalRequest";
  Findings findings;
  judge_action_servers("/arm/other", {peer}, {server}, findings);
  EXPECT_TRUE(findings.all().empty());
  judge_action_servers("/arm/follow", {peer}, {server}, findings);
  EXPECT_SAID(findings, "wrong arm: /arm/follow is served by a peer on 01.01, whose actions");
  Findings understood;
  peer.vendor = {0x01, 0x10};
  judge_action_servers("/arm/follow", {peer}, {server}, understood);
  EXPECT_TRUE(understood.all().empty());
}

template <std::size_t N>
Payload discovery(std::size_t endpoints) {
  rmw_dds_common::ParticipantEntitiesInfo<N> info;
  rmw_dds_common::NodeEntitiesInfo<N> node;
  node.node_namespace = "/cell";
  node.node_name = "camera";
  node.reader_gid_seq.resize(endpoints);
  node.writer_gid_seq.resize(endpoints);
  info.node_entities_info_seq = {node, node};
  info.node_entities_info_seq[1].node_namespace = "/";
  return to_cdr(info);
}

TEST(Ros2Check, NodeNamesInBothLayouts) {
  const std::set<std::string> names = {"/cell/camera", "/camera"};
  for (const std::size_t endpoints : {0, 1, 7}) {
    EXPECT_EQ(node_names_in(discovery<24>(endpoints)), names) << endpoints;
    EXPECT_EQ(node_names_in(discovery<16>(endpoints)), names) << endpoints;
  }
  EXPECT_TRUE(node_names_in({0, 1, 0, 0, 255, 255, 255, 255}).empty());
}

TEST(Ros2Check, LooksAroundAreNearFreeAndDifferent) {
  const RobotModel& robot = checked_robot();
  const CollisionChecker checker(robot, {1.0, 0.0});
  const Configuration home = robot.home("side_1");
  const auto looks = looks_around(robot, checker, home);
  ASSERT_GE(looks.size(), 7u);
  const Pose T_base_home = robot.T_base_camera(home);
  double turned = 0.0;
  for (const Configuration& look : looks) {
    EXPECT_TRUE(checker.edge_free(home, look));
    const Pose off = T_base_home.inverse(Eigen::Isometry) * robot.T_base_camera(look);
    EXPECT_LT(off.translation().norm(), 0.15);
    turned = std::max(turned, Eigen::AngleAxisd(Eigen::Matrix3d(off.linear())).angle());
  }
  EXPECT_GT(turned, 0.35);
}

TEST(Ros2Check, WordsOfAnEstimate) {
  HandEyeEstimate estimate;
  estimate.hand_eye_known = estimate.time_known = true;
  estimate.hand_eye_wrong = true;
  estimate.T_said_true.translation() = Vec3(0.01, 0.0, -0.02);
  estimate.translation_m = 0.0224;
  estimate.translation_se_m = 0.0002;
  estimate.frames = {{0.003, 0.001, 500}, {0.004, 0.001, 500}};
  estimate.all = {0.0035, 0.001, 1000};
  Findings findings;
  Pose T_frame_camera = Pose::Identity();
  T_frame_camera.translation() = Vec3(0.1, 0.0, 0.0);
  tell_hand_eye(estimate, {T_frame_camera, 0.02, false, 2}, findings);
  EXPECT_SAID(findings, "wrong hand-eye: the camera sits 22.4 mm (+- 0.6)");
  EXPECT_SAID(findings,
              "camera_mounting: {xyz_m: [0.1100, 0.0000, -0.0200], rpy_deg: [0.00, 0.00, 0.00]}");
  EXPECT_SAID(findings, "ok time offset");
  EXPECT_SAID(findings,
              "disagree by 3.5 mm, with what was found by 1.0 mm; where the arm stood, in mm: "
              "3.0>1.0 4.0>1.0");
  estimate.time_wrong = true;
  estimate.time_offset_s = -0.05;
  estimate.hand_eye_known = estimate.hand_eye_wrong = false;
  Findings other;
  tell_hand_eye(estimate, {T_frame_camera, 0.02, false, 2}, other);
  EXPECT_SAID(other,
              "too late by the clock of joint states: set ros2.camera.time_offset_s to -0.030");
  EXPECT_SAID(other, "notice hand-eye");
}

}  // namespace
}  // namespace canopeer::ros
