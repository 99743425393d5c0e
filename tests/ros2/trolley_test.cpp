#include <gtest/gtest.h>

#include <future>
#include <numbers>

#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"
#include "canopeer/map/fusion.h"
#include "canopeer/robot/arm_extent.h"
#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/trolley/ros2_trolley.h"
#include "ros_fixture.h"
#include "support/must.h"
#include "support/planning_fixture.h"
#include "test_controller.h"

namespace canopeer::ros {
namespace {

using std_srvs::Trigger;
using test::test_robot;
using testing_support::ControllerFaults;
using testing_support::eventually;
using testing_support::TestController;
using namespace std::chrono_literals;

/// Stands at a place.
struct StandingArm : Arm {
  Configuration q = test_robot().home("side_1");
  Configuration configuration() const override { return q; }
  Expected<double> start(const JointPath&) override { return fail("it stands"); }
  Expected<MotionOutcome> finish() override { return fail("it stands"); }
};

class Ros2TrolleyTest : public ::testing::Test {
 protected:
  void start(const Ros2Settings& settings, const TrolleyState& first = {1.0, 0.0}) {
    sense_.emplace(test_robot(), settings.trolley, first);
    listener_.emplace(settings.arm.joint_names, sense_->by_joint_states(),
                      [this] { return clock_.now(); });
    must(listener_->listen(*node_, settings.arm.joint_states));
    must(sense_->listen(*node_, clock_));
    PersonHooks person;
    person.stop_asked = [this] { return stop_.load(); };
    person.say = [this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      said_.push_back(text);
    };
    if (settings.confirm) {
      person.may_move = [this](const std::string&) {
        arm_.q[1] += nudge_;
        return true;
      };
    }
    const auto fresh = [this]() -> Expected<void> {
      if (arm_silent_) return fail("lost the arm");
      return {};
    };
    trolley_ = must(Ros2Trolley::make({*node_, test_robot(), *sense_, clock_, person, fresh}, arm_,
                                      settings, [this] { ++moved_; }));
    ASSERT_TRUE(eventually([&] { return trolley_->missing().empty(); }));
  }
  static Ros2Settings settings_of(Ros2TrolleySettings::Kind kind) {
    Ros2Settings settings;
    settings.trolley.kind = kind;
    return settings;
  }
  std::string last_said() {
    const std::lock_guard lock(mutex_);
    return said_.empty() ? "" : said_.back();
  }
  static std::string error_of(const Expected<void>& outcome) {
    return outcome ? "none" : outcome.error().message;
  }

  std::unique_ptr<Node> robot_node_ = testing_support::make_node("robot");
  std::unique_ptr<Node> node_ = testing_support::make_node("canopeer");
  RosClock clock_;
  StandingArm arm_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> arm_silent_{false};
  double nudge_ = 0.0;  ///< of the arm, while a person is asked
  std::mutex mutex_;
  std::vector<std::string> said_;
  int moved_ = 0;
  std::optional<TrolleySense> sense_;
  std::optional<JointListener> listener_;
  std::unique_ptr<Ros2Trolley> trolley_;
};

TEST_F(Ros2TrolleyTest, FixedStaysWhereItIs) {
  start(settings_of(Ros2TrolleySettings::Kind::fixed));
  EXPECT_EQ(trolley_->state().travel_m, 1.0);
  EXPECT_TRUE(trolley_->move_to({1.0, 0.0}));
  EXPECT_NE(error_of(trolley_->move_to({1.5, 0.0})).find("it is fixed at travel 1.000 m"),
            std::string::npos);
}

TEST_F(Ros2TrolleyTest, DoesNotMoveUnlessTheArmIsHome) {
  start(settings_of(Ros2TrolleySettings::Kind::fixed));
  arm_.q[1] += 0.3;
  EXPECT_NE(error_of(trolley_->move_to({1.5, 0.0})).find("the arm is not at home"),
            std::string::npos);
}

TEST_F(Ros2TrolleyTest, LooksAtTheArmAgainAfterThePersonsAnswer) {
  Ros2Settings settings = settings_of(Ros2TrolleySettings::Kind::fixed);
  settings.confirm = true;
  start(settings);
  nudge_ = 0.3;
  EXPECT_NE(error_of(trolley_->move_to({1.5, 0.0})).find("the arm is not at home"),
            std::string::npos);
}

TEST_F(Ros2TrolleyTest, DoesNotMoveWhenNothingIsHeardOfTheArm) {
  start(settings_of(Ros2TrolleySettings::Kind::fixed));
  arm_silent_ = true;
  EXPECT_EQ(error_of(trolley_->move_to({1.5, 0.0})), "lost the arm");
}

TEST_F(Ros2TrolleyTest, DoesNotLeaveItsLimits) {
  start(settings_of(Ros2TrolleySettings::Kind::fixed));
  EXPECT_NE(error_of(trolley_->move_to({1000.0, 0.0})).find("beyond the axes' limits"),
            std::string::npos);
}

TEST_F(Ros2TrolleyTest, OfADryRunStaysToo) {
  Ros2Settings settings = settings_of(Ros2TrolleySettings::Kind::fixed);
  settings.dry_run = true;
  start(settings);
  EXPECT_TRUE(trolley_->move_to({1.5, 0.0}));
  EXPECT_EQ(trolley_->state().travel_m, 1.0);
  EXPECT_NE(last_said().find("dry run"), std::string::npos);
}

TEST_F(Ros2TrolleyTest, DoesNotMoveAfterAStop) {
  start(settings_of(Ros2TrolleySettings::Kind::manual));
  stop_ = true;
  EXPECT_TRUE(trolley_->move_to({1.5, 0.0}));
  EXPECT_EQ(last_said(), "");
  EXPECT_EQ(trolley_->state().travel_m, 1.0);
}

/// A controller for the axes that the robot has.
class TrajectoryTrolley : public Ros2TrolleyTest {
 protected:
  void begin() {
    std::vector<std::string> axes = {test_robot().setup().travel_joint};
    if (!test_robot().setup().lift_joint.empty()) axes.push_back(test_robot().setup().lift_joint);
    controller_.emplace(*robot_node_, "/trolley/follow", axes,
                        std::vector<double>(axes.size(), 0.5));
    Ros2Settings settings = settings_of(Ros2TrolleySettings::Kind::trajectory);
    settings.trolley.action = "/trolley/follow";
    settings.trolley.speed_m_s = 0.5;
    start(settings);
    ASSERT_TRUE(eventually([&] { return sense_->silent(0.5).empty(); }));
  }
  std::optional<TestController> controller_;
};

TEST_F(TrajectoryTrolley, DrivesAndArrives) {
  begin();
  EXPECT_NEAR(trolley_->state().travel_m, 0.5, 1e-9);
  const auto driven = trolley_->move_to({0.6, 0.5});
  EXPECT_TRUE(driven) << driven.error().message;
  EXPECT_NEAR(trolley_->state().travel_m, 0.6, 0.005);
  EXPECT_EQ(moved_, 1);
  EXPECT_TRUE(trolley_->move_to({0.6, 0.5}));  // is there
  EXPECT_EQ(controller_->goals(), 1);
}

TEST_F(TrajectoryTrolley, DrivesNoFasterThanItIsToldWhileTheArmLooksAtTheRow) {
  begin();
  arm_.q[5] += 0.5;  // the camera turned about its axis: away from home, still in the aisle
  ASSERT_TRUE(keeps_to_aisle(test_robot(), arm_.q));
  EXPECT_FALSE(trolley_->move_to({0.55, 0.5}));
  const auto slow = trolley_->set_out({{0.55, 0.5}, 0.1, true});
  ASSERT_TRUE(slow) << slow.error().message;
  EXPECT_GT(*slow, 0.5);  // 5 cm at 10 cm/s at most
  EXPECT_EQ(moved_, 0);
  const auto arrived = trolley_->arrive();
  EXPECT_TRUE(arrived) << arrived.error().message;
  EXPECT_EQ(moved_, 1);
  EXPECT_NEAR(trolley_->state().travel_m, 0.55, 0.005);
  const auto there = trolley_->set_out({{0.55, 0.5}, 0.1, true});
  ASSERT_TRUE(there);
  EXPECT_EQ(*there, 0.0);
  EXPECT_TRUE(trolley_->arrive());
  EXPECT_EQ(controller_->goals(), 1);
}

TEST_F(TrajectoryTrolley, DoesNotDriveWithTheArmAmongThePlants) {
  begin();
  arm_.q = Configuration::Zero(arm_.q.size());  // stretched out along the row
  arm_.q[0] = std::numbers::pi / 2.0;           // and turned across it
  const auto refused = trolley_->set_out({{0.6, 0.5}, 0.1, true});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("nor within the aisle"), std::string::npos);
  EXPECT_EQ(controller_->goals(), 0);
}

TEST_F(TrajectoryTrolley, SaysWhyItDidNotArrive) {
  begin();
  controller_->faults([](ControllerFaults& f) {
    f.end_at = 0.4;
    f.end_code = -4;
  });
  EXPECT_NE(error_of(trolley_->move_to({0.6, 0.5})).find("left its path"), std::string::npos);
  controller_->faults([](ControllerFaults& f) { f.reject = true; });
  EXPECT_NE(error_of(trolley_->move_to({0.7, 0.5})).find("refuses to drive"), std::string::npos);
}

TEST_F(TrajectoryTrolley, IsLostWhenNothingIsHeardOfIt) {
  begin();
  controller_->faults([](ControllerFaults& f) { f.joint_states = false; });
  EXPECT_NE(error_of(trolley_->move_to({1.5, 0.5})).find("lost it"), std::string::npos);
  EXPECT_EQ(controller_->cancels(), 1);
}

TEST_F(TrajectoryTrolley, StopsWhenAPersonWantsThat) {
  begin();
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.5}); });
  ASSERT_TRUE(eventually([&] { return controller_->goals() == 1; }));
  stop_ = true;
  EXPECT_TRUE(driving.get());
  EXPECT_EQ(controller_->cancels(), 1);
  EXPECT_LT(trolley_->state().travel_m, 1.5);
}

TEST_F(TrajectoryTrolley, StopsWhenNothingIsHeardOfTheArm) {
  begin();
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.5}); });
  ASSERT_TRUE(eventually([&] { return controller_->goals() == 1; }));
  arm_silent_ = true;
  EXPECT_NE(error_of(driving.get()).find("lost the arm"), std::string::npos);
  EXPECT_EQ(controller_->cancels(), 1);
}

/// A travel axis that goes where a topic says, a millimetre every millisecond.
class TopicsTrolley : public Ros2TrolleyTest {
 protected:
  void begin(double timeout_s = 30.0) {
    state_ = must(robot_node_->advertise<std_msgs::Float64>("/travel/state"));
    command_ = must(robot_node_->subscribe<std_msgs::Float64>(
        "/travel/command", kDefaultQos,
        [this](const std_msgs::Float64& said, const Guid&) { goal_ = said.data; }));
    thread_ = std::jthread([this](std::stop_token stop) {
      while (!stop.stop_requested()) {
        place_ += std::clamp(goal_ - place_, -0.01, 0.01) * !stuck_;
        if (!silent_) state_.publish({place_});
        std::this_thread::sleep_for(10ms);
      }
    });
    Ros2Settings settings = settings_of(Ros2TrolleySettings::Kind::topics);
    settings.trolley.travel_command = "/travel/command";
    settings.trolley.travel_state = "/travel/state";
    settings.trolley.lift_state = "/lift/state";
    settings.trolley.timeout_s = timeout_s;
    lift_ = must(robot_node_->advertise<std_msgs::Float64>("/lift/state"));
    start(settings, {1.0, 0.2});
    ASSERT_TRUE(eventually([&] {
      lift_.publish({0.2});
      return sense_->silent(1e9).empty();
    }));
  }
  Expected<void> drive(double travel_m) {
    lift_.publish({0.2});
    return trolley_->move_to({travel_m, 0.2});
  }
  Publisher<std_msgs::Float64> state_;
  Publisher<std_msgs::Float64> lift_;
  Subscription command_;
  std::atomic<double> goal_{1.0};
  std::atomic<bool> stuck_{false};
  std::atomic<bool> silent_{false};
  double place_ = 1.0;
  std::jthread thread_;
};

TEST_F(TopicsTrolley, IsToldWhereAndWaitedFor) {
  begin();
  const auto driven = drive(1.2);
  EXPECT_TRUE(driven) << driven.error().message;
  EXPECT_NEAR(trolley_->state().travel_m, 1.2, 0.005);
}

TEST_F(TopicsTrolley, CannotBeToldHowFast) {
  begin();
  lift_.publish({0.2});
  const auto slow = trolley_->set_out({{1.2, 0.2}, 0.1, true});
  ASSERT_FALSE(slow);
  EXPECT_NE(slow.error().message.find("cannot be told how fast"), std::string::npos);
  EXPECT_TRUE(trolley_->set_out({{1.2, 0.2}, 0.0, true}));
  const auto arrived = trolley_->arrive();
  EXPECT_TRUE(arrived) << arrived.error().message;
  EXPECT_NEAR(trolley_->state().travel_m, 1.2, 0.005);
}

TEST_F(TopicsTrolley, SaysThatItDidNotArrive) {
  begin(0.3);
  stuck_ = true;
  EXPECT_NE(error_of(drive(1.2)).find("did not arrive within"), std::string::npos);
  EXPECT_TRUE(eventually([&] { return goal_ == 1.0; })) << "it is to stay where it is";
}

TEST_F(TopicsTrolley, IsLostWhenItsPlaceIsSaidNoMore) {
  begin();
  stuck_ = true;
  silent_ = true;
  EXPECT_NE(error_of(drive(1.5)).find("lost it: nothing was heard of"), std::string::npos);
  EXPECT_TRUE(eventually([&] { return goal_ == 1.4; })) << "where it would be after two seconds";
}

/// A person at the trolley.
class ManualTrolley : public Ros2TrolleyTest {
 protected:
  Trigger::Response call() {
    if (!client_) {
      client_.emplace(must(Client<Trigger>::make(*robot_node_, "/canopeer/trolley_arrived")));
    }
    EXPECT_TRUE(eventually([&] { return client_->ready(); }));
    return must(client_->call({}, 10s));
  }
  std::optional<Client<Trigger>> client_;
};

TEST_F(ManualTrolley, WaitsForThePerson) {
  start(settings_of(Ros2TrolleySettings::Kind::manual));
  EXPECT_FALSE(call().success);
  EXPECT_TRUE(trolley_->move_to({1.0, 0.0}));  // is there
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.0}); });
  ASSERT_TRUE(eventually([&] { return !last_said().empty(); }));
  EXPECT_EQ(last_said(),
            "push the trolley to travel 1.500 m, lift 0.000 m (now at travel 1.000 m, lift 0.000 "
            "m), then call /canopeer/trolley_arrived");
  EXPECT_EQ(driving.wait_for(0ms), std::future_status::timeout);
  EXPECT_TRUE(call().success);
  EXPECT_TRUE(driving.get());
  EXPECT_EQ(trolley_->state().travel_m, 1.5);
}

TEST_F(ManualTrolley, IsLeftWhereItIsWhenAPersonStopsTheRun) {
  start(settings_of(Ros2TrolleySettings::Kind::manual));
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.0}); });
  ASSERT_TRUE(eventually([&] { return !last_said().empty(); }));
  stop_ = true;
  EXPECT_TRUE(driving.get());
  EXPECT_EQ(trolley_->state().travel_m, 1.0);
  EXPECT_FALSE(call().success);
}

TEST_F(ManualTrolley, WhosePlaceIsMeasuredIsSentOnWhenItIsTooFarOff) {
  Ros2Settings settings = settings_of(Ros2TrolleySettings::Kind::manual);
  settings.trolley.travel_state = "/travel/state";
  const auto state = must(robot_node_->advertise<std_msgs::Float64>("/travel/state"));
  start(settings);
  const auto pushed_to = [&](double place) {
    return eventually([&] {
      state.publish({place});
      return trolley_->state().travel_m == place;
    });
  };
  ASSERT_TRUE(pushed_to(1.3));
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.1}); });
  ASSERT_TRUE(eventually([&] { return !last_said().empty(); }));
  const Trigger::Response too_early = call();
  EXPECT_FALSE(too_early.success);
  EXPECT_NE(too_early.message.find("it stands at travel 1.300 m"), std::string::npos);
  EXPECT_EQ(trolley_->state().lift_m, 0.0) << "nothing is believed of who is not there";
  ASSERT_TRUE(pushed_to(1.45));
  EXPECT_TRUE(call().success);
  EXPECT_TRUE(driving.get());
  EXPECT_EQ(trolley_->state().travel_m, 1.45);
}

TEST_F(ManualTrolley, IsPlacedByTheMapOnce) {
  start(settings_of(Ros2TrolleySettings::Kind::manual));
  const VoxelMap map;
  RgbdFrame frame;
  EXPECT_TRUE(trolley_->check_place(&map, frame));
  EXPECT_EQ(last_said(), "");  // nothing was pushed
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.0}); });
  ASSERT_TRUE(eventually([&] { return !last_said().empty(); }));
  ASSERT_TRUE(call().success);
  ASSERT_TRUE(driving.get());
  EXPECT_TRUE(trolley_->check_place(&map, frame));
  EXPECT_NE(last_said().find("nothing is mapped yet"), std::string::npos);
  const std::size_t said = said_.size();
  EXPECT_TRUE(trolley_->check_place(&map, frame));
  EXPECT_EQ(said_.size(), said);
}

/// A wall along the row looks the same wherever the trolley stands.
TEST_F(ManualTrolley, IsConfirmedOnceMoreWhereTheMapIsUnclear) {
  start(settings_of(Ros2TrolleySettings::Kind::manual));
  RgbdFrame frame;
  frame.T_world_camera = Pose(Eigen::Translation3d(0.5, 2.0, 1.0) *
                              Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY()));
  frame.depth = DepthImage(frame.intrinsics.width, frame.intrinsics.height, 1.0F);
  VoxelMap map;
  RgbdFrame beside = frame;
  for (double y = 1.0; y <= 3.0; y += 0.2) {
    beside.T_world_camera.translation().y() = y;
    fuse(map, beside, Mask());
  }
  auto driving = std::async(std::launch::async, [&] { return trolley_->move_to({1.5, 0.0}); });
  ASSERT_TRUE(eventually([&] { return !last_said().empty(); }));
  ASSERT_TRUE(call().success);
  ASSERT_TRUE(driving.get());
  auto placing = std::async(std::launch::async, [&] { return trolley_->check_place(&map, frame); });
  ASSERT_TRUE(eventually([&] { return last_said().find("call once more") != std::string::npos; }));
  EXPECT_EQ(placing.wait_for(0ms), std::future_status::timeout);
  EXPECT_TRUE(call().success);
  EXPECT_TRUE(placing.get());
  EXPECT_FALSE(trolley_->in_doubt());
  EXPECT_EQ(moved_, 2) << "frames from before count no more";
}

}  // namespace
}  // namespace canopeer::ros
