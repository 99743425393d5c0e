// SRDFs as MoveIt reads them, and robots that have none.

#include "canopeer/config/srdf.h"

#include "canopeer/robot/robot_survey.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::has;
using test::notices_of;

bool checked(const RobotModel& robot, const std::string& a, const std::string& b) {
  return robot.pair_checked(robot.link_index(a), robot.link_index(b));
}

TEST(Srdf, ThatNamesLinksTheRobotHasNotIsTakenForWhatItHas) {
  const RobotModel robot = test::robot_of("foreign_srdf/gripper.yaml");
  const std::string notices = notices_of(robot);
  EXPECT_TRUE(has(notices,
                  "gripper.srdf:4: the robot has no link 'left_finger', 'right_finger'; "
                  "what is said of them is left out"))
      << notices;
  EXPECT_FALSE(has(notices, "another robot")) << notices;
  EXPECT_FALSE(checked(robot, "link5", "link6"));
  EXPECT_TRUE(checked(robot, "link4", "link5"));  // it says all there is to say
}

TEST(Srdf, OfAnotherRobotIsNoticedAndCountsAsNone) {
  const RobotModel robot = test::robot_of("foreign_srdf/other.yaml");
  const std::string notices = notices_of(robot);
  EXPECT_TRUE(has(notices, "other.srdf:2: this is the SRDF of another robot")) << notices;
  EXPECT_TRUE(has(notices, "it is of 'humanoid', the URDF of 'small_arm'")) << notices;
  EXPECT_FALSE(checked(robot, "link4", "link5"));
  EXPECT_TRUE(checked(robot, "link4", "link6"));
}

TEST(Srdf, DisablesByDefaultButForWhatItEnables) {
  const RobotModel robot = test::robot_of("foreign_srdf/default_off.yaml");
  EXPECT_EQ(notices_of(robot), "");
  for (const char* other : {"link1", "link2", "link3", "link5"}) {
    EXPECT_FALSE(checked(robot, "link4", other)) << other;
    EXPECT_FALSE(checked(robot, other, "link4")) << other;
  }
  EXPECT_TRUE(checked(robot, "base", "link4"));
  EXPECT_FALSE(checked(robot, "link4", "link6"));  // enabled, and disabled by itself
  EXPECT_TRUE(checked(robot, "link3", "link5"));
}

TEST(WithoutSrdf, LinksThatAJointConnectsAreLeftOut) {
  const RobotModel robot = test::robot_of("base_on_floor/robot.yaml");
  EXPECT_FALSE(checked(robot, "base", "link1"));
  EXPECT_FALSE(checked(robot, "link5", "link6"));
  EXPECT_TRUE(checked(robot, "base", "link2"));
  EXPECT_TRUE(checked(robot, "link3", "link5"));
}

TEST(WithoutSrdf, ALinkInBetweenThatHasNoShapeMakesNoDifference) {
  RobotModel robot = test::robot_of("base_on_floor/robot.yaml");
  RobotDescription description = robot.description();
  for (Link& link : description.links) {
    if (link.name == "link4") link.collision.clear();
  }
  const auto model = RobotModel::make(description, robot.setup());
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_FALSE(checked(*model, "link3", "link5"));
  EXPECT_TRUE(checked(*model, "link3", "link6"));
}

TEST(WithoutSrdf, TheSurveyOfReachMeansTheSame) {
  const RobotModel robot = test::robot_of("base_on_floor/robot.yaml");
  const auto ik = ArmIk::make(robot);
  ASSERT_TRUE(ik) << ik.error().message;
  const ReachSurvey survey = survey_reach(robot, *ik, 1, 100, 1);
  EXPECT_GT(survey.free, 30);
  for (const LinkPairSurvey& pair : survey_link_pairs(robot, 20, 1)) {
    EXPECT_EQ(pair.disabled, pair.adjacent) << pair.link_a << " / " << pair.link_b;
  }
}

}  // namespace
}  // namespace canopeer
