// A trolley that a person pushes some centimetres too far, in front of the simulated row.

#include <gtest/gtest.h>

#include <future>
#include <mutex>

#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"
#include "canopeer/map/fusion.h"
#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/ros2_site.h"
#include "robot_in_process.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using canopeer::testing_support::SmokeWorld;
using std_srvs::Trigger;
using testing_support::eventually;
using namespace std::chrono_literals;

TEST(PushedTrolley, IsPlacedByTheFirstFrameFromThere) {
  const auto robot = canopeer::testing_support::start_smoke_robot();
  ASSERT_NE(robot, nullptr);
  MissionFile file = SmokeWorld::get().file;
  file.ros2->discovery_s = 60.0;
  file.ros2->output.enabled = false;
  std::mutex mutex;
  std::string said;
  SiteCallbacks callbacks;
  callbacks.on_message = [&](const std::string& text) {
    const std::lock_guard lock(mutex);
    said = text;
  };
  const auto last_said = [&] {
    const std::lock_guard lock(mutex);
    return said;
  };
  const auto site = must(make_ros2_site({file, *SmokeWorld::get().robot, callbacks}));
  VoxelMap map(file.mission.map);
  site->watch_map(&map);
  const Ports ports = site->ports();
  const RgbdFrame home = must(ports.camera->capture());
  fuse(map, home, Mask(), file.mission.fusion);

  // A person pushes the trolley to 1.447 m in place of 1.4 m.
  const auto person = testing_support::make_node("person");
  JointHistory rail({SmokeWorld::get().robot->setup().travel_joint});
  JointListener listener({}, {&rail}, [] { return Stamp{1}; });
  must(listener.listen(*person, {"/joint_states"}));
  const auto push =
      must(person->advertise<std_msgs::Float64MultiArray>("/simulated_robot/push_trolley"));
  auto arrived = must(Client<Trigger>::make(*person, "/canopeer/trolley_arrived"));
  ASSERT_TRUE(eventually([&] { return arrived.ready() && push.readers() > 0; }));
  auto moving = std::async(std::launch::async, [&] { return ports.trolley->move_to({1.4, 0.0}); });
  ASSERT_TRUE(eventually([&] { return !last_said().empty(); }));
  std_msgs::Float64MultiArray there;
  there.data = {1.447, 0.0};
  push.publish(there);
  ASSERT_TRUE(
      eventually([&] { return rail.last() && std::abs(rail.last()->front() - 1.447) < 1e-4; }));
  ASSERT_TRUE(must(arrived.call({}, 10s)).success);
  must(moving.get());
  const RgbdFrame frame = must(ports.camera->capture());
  EXPECT_NEAR(ports.trolley->state().travel_m, 1.447, 0.006) << last_said();
  EXPECT_NE(last_said().find("by the map it stands at travel 1.4"), std::string::npos);
  const Vec3 moved = frame.T_world_camera.translation() - home.T_world_camera.translation();
  EXPECT_NEAR(moved.y(), 0.447, 0.006);
  EXPECT_NEAR(moved.x(), 0.0, 1e-3);
  // The next frame is taken from there, without another look at the map.
  const std::string before = last_said();
  const RgbdFrame next = must(ports.camera->capture());
  EXPECT_NEAR((next.T_world_camera.translation() - frame.T_world_camera.translation()).norm(), 0.0,
              1e-3);
  EXPECT_EQ(last_said(), before);
}

}  // namespace
}  // namespace canopeer::ros
