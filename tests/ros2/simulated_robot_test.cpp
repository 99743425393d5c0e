// The simulated robot as any ROS 2 program sees it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "canopeer/cdr/messages/control_msgs.h"
#include "canopeer/cdr/messages/rosgraph_msgs.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/dds/action.h"
#include "canopeer/dds/service.h"
#include "canopeer/render/renderer.h"
#include "canopeer/ros2/time/stamp.h"
#include "dds/ros_fixture.h"
#include "robot_in_process.h"

namespace canopeer::ros {
namespace {

using canopeer::testing_support::SmokeWorld;
using canopeer::testing_support::start_smoke_robot;
using control_msgs::FollowJointTrajectory;
using testing_support::eventually;
using testing_support::make_node;

/// The last message of a topic.
template <class Message>
class Heard {
 public:
  Heard(Node& node, const std::string& topic, const Qos& qos = {}) {
    auto made = node.subscribe<Message>(topic, qos, [this](Message&& message, const Guid&) {
      const std::scoped_lock lock(mutex_);
      last_ = std::move(message);
      ++count_;
    });
    if (made) subscription_ = std::move(*made);
  }
  int count() const {
    const std::scoped_lock lock(mutex_);
    return count_;
  }
  Message last() const {
    const std::scoped_lock lock(mutex_);
    return last_;
  }
  bool comes(int more = 1) {
    const int before = count();
    return eventually([&] { return count() >= before + more; });
  }

 private:
  mutable std::mutex mutex_;
  Message last_;
  int count_ = 0;
  Subscription subscription_;
};

/// Joint states by name.
double position(const sensor_msgs::JointState& state, const std::string& name) {
  const auto found = std::find(state.name.begin(), state.name.end(), name);
  if (found == state.name.end()) return NAN;
  return state.position[static_cast<std::size_t>(found - state.name.begin())];
}

/// What a client of the arm's action is told.
struct Told {
  std::mutex mutex;
  int feedback = 0;
  GoalState state = GoalState::unknown;
  FollowJointTrajectory::Result result;
  GoalState ended() {
    const std::scoped_lock lock(mutex);
    return state;
  }
  int heard() {
    const std::scoped_lock lock(mutex);
    return feedback;
  }
  ActionClient<FollowJointTrajectory>::Events events() {
    return {[this](const FollowJointTrajectory::Feedback&) {
              const std::scoped_lock lock(mutex);
              ++feedback;
            },
            {},
            [this](GoalState s, const FollowJointTrajectory::Result& r) {
              const std::scoped_lock lock(mutex);
              state = s;
              result = r;
            }};
  }
};

/// The first joint moves by 0.3 rad in that time.
FollowJointTrajectory::Goal small_motion(double seconds, double from = 0.0) {
  const SmokeWorld& world = SmokeWorld::get();
  FollowJointTrajectory::Goal goal;
  goal.trajectory.joint_names = world.robot->setup().arm_joints;
  Configuration q = world.robot->home("side_1");
  q[0] += from;
  for (const double t : {0.0, seconds}) {
    trajectory_msgs::JointTrajectoryPoint point;
    point.positions.assign(q.data(), q.data() + q.size());
    point.positions[0] += 0.3 * t / seconds;
    point.velocities.assign(static_cast<std::size_t>(q.size()), 0.0);
    const auto ns = nanoseconds(t);
    point.time_from_start = {static_cast<std::int32_t>(ns / kNanosecondsPerSecond),
                             static_cast<std::uint32_t>(ns % kNanosecondsPerSecond)};
    goal.trajectory.points.push_back(point);
  }
  return goal;
}

constexpr std::chrono::seconds kPatience{20};

std::unique_ptr<ActionClient<FollowJointTrajectory>> arm_client(Node& node) {
  auto client = ActionClient<FollowJointTrajectory>::make(node, Ros2ArmSettings().action);
  if (!client) return nullptr;
  EXPECT_TRUE(eventually([&] { return (*client)->ready(); }));
  return std::move(*client);
}

TEST(SimulatedRobot, SaysItsJointsInAnOrderOfItsOwnAndSomeMore) {
  const auto robot = start_smoke_robot();
  const auto node = make_node("listener");
  Heard<sensor_msgs::JointState> joints(*node, "/joint_states");
  ASSERT_TRUE(joints.comes(10));
  const auto state = joints.last();
  EXPECT_TRUE(std::is_sorted(state.name.begin(), state.name.end()));
  EXPECT_EQ(state.name.size(), 9U);
  EXPECT_NEAR(position(state, "elbow_joint"), 1.5707963, 1e-6);
  EXPECT_NEAR(position(state, "trolley_travel"), 1.0, 1e-9);
  EXPECT_EQ(position(state, "gripper_finger_joint"), 0.02);
  // It is the wall's time.
  const double now = seconds(std::chrono::system_clock::now().time_since_epoch().count());
  EXPECT_NEAR(seconds(stamp_of(state.header.stamp)), now, 30.0);
}

TEST(SimulatedRobot, FollowsATrajectoryAndSaysSo) {
  const auto robot = start_smoke_robot();
  const auto node = make_node("planner");
  Heard<sensor_msgs::JointState> joints(*node, "/joint_states");
  const auto client = arm_client(*node);
  ASSERT_TRUE(client);
  Told told;
  const auto accepted = client->send(small_motion(0.5), told.events(), kPatience);
  ASSERT_TRUE(accepted) << accepted.error().message;
  EXPECT_TRUE(*accepted);
  ASSERT_TRUE(eventually([&] { return told.ended() != GoalState::unknown; }));
  EXPECT_EQ(told.ended(), GoalState::succeeded);
  EXPECT_GT(told.heard(), 2);
  ASSERT_TRUE(joints.comes(2));
  EXPECT_NEAR(position(joints.last(), "shoulder_pan_joint"), 0.3, 1e-3);
  const auto report = robot->report();
  EXPECT_EQ(report.goals, 1);
  EXPECT_EQ(report.arrived, 1);
  EXPECT_EQ(report.collisions, 0);
}

TEST(SimulatedRobot, RefusesCancelsAndIsPreempted) {
  const auto robot = start_smoke_robot();
  const auto node = make_node("planner");
  const auto client = arm_client(*node);
  ASSERT_TRUE(client);
  Told far;
  const auto refused = client->send(small_motion(0.5, 1.0), far.events(), kPatience);
  ASSERT_TRUE(refused) << refused.error().message;
  EXPECT_FALSE(*refused);

  Told cancelled;
  ASSERT_TRUE(client->send(small_motion(5.0), cancelled.events(), kPatience).value_or(false));
  EXPECT_TRUE(client->cancel(kPatience).value_or(false));
  ASSERT_TRUE(eventually([&] { return cancelled.ended() != GoalState::unknown; }));
  EXPECT_EQ(cancelled.ended(), GoalState::canceled);

  Told preempted;
  ASSERT_TRUE(client->send(small_motion(5.0), preempted.events(), kPatience).value_or(false));
  const auto other = make_node("other_planner");
  const auto others = arm_client(*other);
  ASSERT_TRUE(others);
  Told told;
  ASSERT_TRUE(others->send(small_motion(0.5), told.events(), kPatience).value_or(false));
  ASSERT_TRUE(eventually([&] { return told.ended() != GoalState::unknown; }));
  EXPECT_EQ(told.ended(), GoalState::succeeded);
  ASSERT_TRUE(eventually([&] { return preempted.ended() != GoalState::unknown; }));
  EXPECT_EQ(preempted.ended(), GoalState::canceled);
  EXPECT_EQ(robot->report().cut_short, 2);
}

TEST(SimulatedRobot, ReleasesAProtectiveStopWhenCalled) {
  const auto robot = start_smoke_robot();
  ASSERT_TRUE(robot->set_fault("protective_stop:0"));
  const auto node = make_node("planner");
  const auto client = arm_client(*node);
  ASSERT_TRUE(client);
  Told stopped;
  ASSERT_TRUE(client->send(small_motion(5.0), stopped.events(), kPatience).value_or(false));
  ASSERT_TRUE(eventually([&] { return stopped.ended() != GoalState::unknown; }));
  Told told;
  EXPECT_FALSE(client->send(small_motion(0.5), told.events(), kPatience).value_or(true));
  auto release = Client<std_srvs::Trigger>::make(*node, "/simulated_robot/release");
  ASSERT_TRUE(release);
  ASSERT_TRUE(eventually([&] { return release->ready(); }));
  const auto released = release->call({}, kPatience);
  ASSERT_TRUE(released) << released.error().message;
  EXPECT_TRUE(released->success);
  EXPECT_TRUE(client->send(small_motion(0.5), told.events(), kPatience).value_or(false));
}

TEST(SimulatedRobot, ItsCameraShowsWhatTheRendererShowsThere) {
  Ros2RobotOptions options;
  options.depth_encoding = "32FC1";
  const auto robot = start_smoke_robot(options);
  const auto node = make_node("viewer");
  const Ros2CameraSettings names;
  Heard<sensor_msgs::Image> color(*node, names.color);
  Heard<sensor_msgs::Image> depth(*node, names.depth);
  Heard<sensor_msgs::CameraInfo> info(*node, names.info);
  ASSERT_TRUE(depth.comes() && color.comes() && info.comes());

  const SmokeWorld& world = SmokeWorld::get();
  const CameraIntrinsics& camera = world.file.simulation.camera;
  const RobotModel& model = *world.robot;
  const RenderedView view =
      Renderer(world.scene)
          .render(camera, model.T_world_base(world.file.mission.segments.front().trolley) *
                              model.T_base_camera(model.home("side_1")));
  const sensor_msgs::Image seen = depth.last();
  ASSERT_EQ(seen.data.size(), view.depth.pixels().size() * 4);
  std::size_t alike = 0;
  for (std::size_t i = 0; i < view.depth.pixels().size(); ++i) {
    float z = 0.0F;
    std::memcpy(&z, seen.data.data() + 4 * i, 4);
    const float truth = view.depth.pixels()[i];
    alike += (truth == 0.0F && std::isnan(z)) || std::abs(z - truth) < 1e-4F ? 1 : 0;
  }
  EXPECT_GT(alike, view.depth.pixels().size() * 99 / 100);
  EXPECT_EQ(color.last().encoding, "rgb8");
  EXPECT_EQ(color.last().data.size(), view.depth.pixels().size() * 3);
  EXPECT_EQ(color.last().header.frame_id, model.setup().camera_frame);
  EXPECT_EQ(info.last().k[0], camera.fx);
  EXPECT_EQ(info.last().k[2], camera.cx - 0.5);
}

TEST(SimulatedRobot, TellsItsFramesAndItsDescription) {
  const auto robot = start_smoke_robot();
  const auto node = make_node("viewer");
  Heard<tf2_msgs::TFMessage> tf(*node, "/tf", kTfQos);
  Heard<tf2_msgs::TFMessage> tf_static(*node, "/tf_static", kLatchedQos);
  Heard<std_msgs::String> description(*node, "/robot_description", kLatchedQos);
  ASSERT_TRUE(tf.comes());
  ASSERT_TRUE(eventually([&] { return tf_static.count() > 0 && description.count() > 0; }));
  std::set<std::string> children;
  for (const auto& message : {tf.last(), tf_static.last()}) {
    for (const auto& t : message.transforms) children.insert(t.child_frame_id);
  }
  for (const Link& link : SmokeWorld::get().robot->links()) {
    EXPECT_EQ(children.count(link.name), 1U) << link.name;
  }
  EXPECT_NE(description.last().data.find("<robot"), std::string::npos);
}

TEST(SimulatedRobot, KeepsATimeOfItsOwnWhereAsked) {
  Ros2RobotOptions options;
  options.sim_time = true;
  options.sim_rate = 0.5;
  const auto robot = start_smoke_robot(options);
  const auto node = make_node("listener");
  Heard<rosgraph_msgs::Clock> clock(*node, "/clock");
  Heard<sensor_msgs::JointState> joints(*node, "/joint_states");
  ASSERT_TRUE(clock.comes(5) && joints.comes());
  const double now_s = seconds(stamp_of(clock.last().clock));
  EXPECT_GT(now_s, 0.0);
  EXPECT_LT(now_s, 1000.0);
  EXPECT_NEAR(seconds(stamp_of(joints.last().header.stamp)), now_s, 60.0);
}

TEST(SimulatedRobot, ItsFaultsAreSwitchedByTopic) {
  const auto robot = start_smoke_robot();
  const auto node = make_node("tester");
  Heard<sensor_msgs::JointState> joints(*node, "/joint_states");
  ASSERT_TRUE(joints.comes());
  auto fault = node->advertise<std_msgs::String>("/simulated_robot/fault");
  ASSERT_TRUE(fault);
  ASSERT_TRUE(eventually([&] { return fault->readers() > 0; }));
  const auto shows = [&](const char* what, const std::function<bool()>& holds) {
    fault->publish({what});
    EXPECT_TRUE(eventually(holds)) << what;
  };
  shows("wrong_names", [&] { return joints.last().name.front().starts_with("other_"); });
  shows("none", [&] { return !joints.last().name.front().starts_with("other_"); });
  shows("nan_positions", [&] { return std::isnan(joints.last().position.front()); });
  shows("none", [&] { return !std::isnan(joints.last().position.front()); });
  shows("malformed", [&] { return node->malformed() > 2; });
  shows("none", [&] { return true; });
  shows("clock_offset:1000", [&] {
    const double now = seconds(std::chrono::system_clock::now().time_since_epoch().count());
    return seconds(stamp_of(joints.last().header.stamp)) > now + 900.0;
  });
}

}  // namespace
}  // namespace canopeer::ros
