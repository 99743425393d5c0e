#include "canopeer/ros2/robot/robot_faults.h"

#include <gtest/gtest.h>

namespace canopeer::ros {
namespace {

TEST(RobotFaults, AreSwitchedByNameWithTheirOwnDefaults) {
  RobotFaults faults;
  EXPECT_FALSE(faults.on(RobotFault::slow));
  ASSERT_TRUE(faults.set("slow"));
  EXPECT_EQ(faults.values(RobotFault::slow).value()[0], 0.3);
  ASSERT_TRUE(faults.set("slow:0.5"));
  EXPECT_EQ(faults.values(RobotFault::slow).value()[0], 0.5);
  ASSERT_TRUE(faults.set("hand_eye:10,1"));
  EXPECT_EQ(faults.values(RobotFault::hand_eye).value()[1], 1.0);
  ASSERT_TRUE(faults.set("slow:off"));
  EXPECT_EQ(faults.said(), std::vector<std::string>{"hand_eye:10,1"});
  ASSERT_TRUE(faults.set("none"));
  EXPECT_TRUE(faults.said().empty());
}

TEST(RobotFaults, WaitForTheirMotion) {
  RobotFaults faults;
  ASSERT_TRUE(faults.set("abort:0.2@2"));
  faults.begin_motion();
  EXPECT_FALSE(faults.on(RobotFault::abort));
  faults.begin_motion();
  EXPECT_TRUE(faults.on(RobotFault::abort));
}

TEST(RobotFaults, OfMotionsAreOverAfterSoManyTimes) {
  RobotFaults faults;
  ASSERT_TRUE(faults.set("reject:2"));
  ASSERT_TRUE(faults.set("vanish"));
  faults.happened(RobotFault::reject);
  EXPECT_TRUE(faults.on(RobotFault::reject));
  faults.happened(RobotFault::reject);
  EXPECT_FALSE(faults.on(RobotFault::reject));
  faults.happened(RobotFault::vanish);
  EXPECT_TRUE(faults.on(RobotFault::vanish));
}

TEST(RobotFaults, ErrorsSayWhatThereIs) {
  RobotFaults faults;
  const auto message = [&](const char* text) {
    const auto ok = faults.set(text);
    return ok ? std::string() : ok.error().message;
  };
  EXPECT_NE(message("slwo").find("protective_stop"), std::string::npos);
  EXPECT_NE(message("slow:fast").find("SCALE"), std::string::npos);
  EXPECT_NE(message("vanish:1").find("no values"), std::string::npos);
  EXPECT_NE(message("slow:0.1,2").find("SCALE"), std::string::npos);
  EXPECT_NE(message("abort@0").find("'@'"), std::string::npos);
  EXPECT_NE(message("abort@x").find("'@'"), std::string::npos);
  EXPECT_TRUE(faults.said().empty());
}

}  // namespace
}  // namespace canopeer::ros
