#include <gtest/gtest.h>

#include <future>

#include "canopeer/dds/service.h"
#include "canopeer/ros2/out/steering_services.h"
#include "heard.h"

namespace canopeer::ros {
namespace {

using std_srvs::Trigger;
using testing_support::eventually;
using testing_support::make_node;
using Kind = SteeringWord::Kind;

class SteeringServicesTest : public ::testing::Test {
 protected:
  void serve(bool wait_for_start = false) {
    services_ =
        must(SteeringServices::make({*node_, consent_, [this] { return saved_; }, wait_for_start}));
  }
  Trigger::Response call(const std::string& name) {
    auto client = must(Client<Trigger>::make(*person_, "/canopeer/" + name));
    EXPECT_TRUE(eventually([&] { return client.ready(); })) << name;
    return must(client.call({}, std::chrono::seconds(20)));
  }
  SteeringWord ask() { return services_->ask({}); }

  std::unique_ptr<Node> node_ = make_node("canopeer");
  std::unique_ptr<Node> person_ = make_node("person");
  MotionConsent consent_{true, {}};
  Expected<std::string> saved_ = "saved in out/x/saved: map.ot";
  std::unique_ptr<SteeringServices> services_;
};

TEST_F(SteeringServicesTest, PauseHoldsUntilGoOn) {
  serve();
  EXPECT_EQ(ask().kind, Kind::go_on);
  EXPECT_TRUE(call("pause").success);
  EXPECT_EQ(ask().kind, Kind::pause);
  EXPECT_EQ(ask().by, "service");
  const auto on = call("go_on");
  EXPECT_TRUE(on.success);
  EXPECT_EQ(on.message, "the mission goes on");
  EXPECT_EQ(ask().kind, Kind::go_on);
  EXPECT_EQ(call("go_on").message, "the mission goes on; nothing held it");
}

TEST_F(SteeringServicesTest, WaitsForStartWhenToldTo) {
  serve(true);
  EXPECT_EQ(ask().kind, Kind::wait_for_person);
  EXPECT_TRUE(call("start").success);
  EXPECT_EQ(ask().kind, Kind::go_on);
}

TEST_F(SteeringServicesTest, EndsASegmentOnceAndARunForGood) {
  serve();
  EXPECT_TRUE(call("next_segment").success);
  EXPECT_EQ(ask().kind, Kind::next_segment);
  EXPECT_EQ(ask().kind, Kind::go_on);
  EXPECT_FALSE(services_->stop_asked());
  EXPECT_TRUE(call("stop").success);
  EXPECT_TRUE(services_->stop_asked());
  EXPECT_EQ(ask().kind, Kind::stop);
  EXPECT_FALSE(call("go_on").success);
  EXPECT_FALSE(call("pause").success);
  EXPECT_EQ(ask().kind, Kind::stop);
}

TEST_F(SteeringServicesTest, SavesAndSaysWhereOrWhyNot) {
  serve();
  EXPECT_EQ(call("save").message, "saved in out/x/saved: map.ot");
  saved_ = fail("nothing was mapped yet");
  const auto not_yet = call("save");
  EXPECT_FALSE(not_yet.success);
  EXPECT_EQ(not_yet.message, "nothing was mapped yet");
}

TEST_F(SteeringServicesTest, AsksAPersonBeforeAMotion) {
  serve();
  EXPECT_FALSE(call("confirm").success) << "nothing waits";
  const auto never = [] { return false; };
  auto first = std::async(std::launch::async, [&] { return consent_.may("move", never); });
  ASSERT_TRUE(eventually([&] { return consent_.question().has_value(); }));
  EXPECT_EQ(call("confirm").message, "allowed: move");
  EXPECT_TRUE(first.get());

  auto second = std::async(std::launch::async, [&] { return consent_.may("move on", never); });
  ASSERT_TRUE(eventually([&] { return consent_.question().has_value(); }));
  EXPECT_EQ(call("refuse").message, "refused: move on");
  EXPECT_FALSE(second.get());
}

TEST(MotionConsent, DoesNotWaitForAnAnswerThatNobodyNeeds) {
  MotionConsent consent(true, {});
  EXPECT_FALSE(consent.may("move", [] { return true; }));
  EXPECT_FALSE(consent.question());
}

TEST(MotionConsent, IsNotAskedWhenSwitchedOff) {
  std::string said;
  MotionConsent consent(false, [&](const std::string& text) { said = text; });
  EXPECT_TRUE(consent.may("move", [] { return false; }));
  EXPECT_EQ(said, "");
  consent.set_asking(true);
  EXPECT_FALSE(consent.may("move", [] { return true; }));
  EXPECT_EQ(said, "may I move? Call ~/confirm or ~/refuse");
}

TEST(MotionConsent, SwitchedOffAllowsWhatIsAskedNow) {
  MotionConsent consent(true, {});
  auto asked =
      std::async(std::launch::async, [&] { return consent.may("move", [] { return false; }); });
  ASSERT_TRUE(eventually([&] { return consent.question().has_value(); }));
  consent.set_asking(false);
  EXPECT_TRUE(asked.get());
}

}  // namespace
}  // namespace canopeer::ros
