#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/mission/steering_desk.h"
#include "canopeer/robot/path_timing.h"
#include "mission_fixture.h"

// Motions that do not arrive, and what a mission makes of them.

namespace canopeer {
namespace {

/// An arm some of whose motions end half-way, in the way they are told to.
class StumblingArm : public Arm {
 public:
  StumblingArm(Arm& arm, std::vector<MotionEnd> ends) : arm_(arm), ends_(std::move(ends)) {}
  Configuration configuration() const override { return arm_.configuration(); }
  Expected<double> start(const JointPath& path) override {
    end_ = begun_ < ends_.size() ? ends_[begun_] : MotionEnd::arrived;
    ++begun_;
    if (end_ == MotionEnd::withheld) return 0.0;  // it stays where it is
    if (end_ == MotionEnd::arrived) return arm_.start(path);
    const PathMotion whole(path, test::test_robot().limits());
    return arm_.start({{path.waypoints.front(), whole.at(0.5 * whole.duration_s())}, {}});
  }
  Expected<MotionOutcome> finish() override {
    if (end_ == MotionEnd::withheld) return MotionOutcome{configuration(), end_, "told to"};
    auto outcome = arm_.finish();
    if (!outcome || end_ == MotionEnd::arrived) return outcome;
    outcome->end = end_;
    outcome->why = "told to";
    return outcome;
  }

 private:
  Arm& arm_;
  std::vector<MotionEnd> ends_;
  std::size_t begun_ = 0;
  MotionEnd end_ = MotionEnd::arrived;
};

TEST_F(MissionTest, AMotionThatDoesNotArriveIsRecordedAndTheMissionGoesOnFromWhereTheArmIs) {
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  using enum MotionEnd;
  StumblingArm arm(*ports.arm, {aborted, arrived, refused, cancelled, arrived, withheld});
  ports.arm = &arm;
  ASSERT_TRUE(run(simulation, ports).has_value());
  EXPECT_FALSE(record_.interrupted);
  ASSERT_EQ(record_.segments.size(), 2U);
  const auto read = read_record(directory_);
  ASSERT_TRUE(read.has_value());
  std::vector<std::string> ends;
  for (const auto& motion : read->motions) {
    if (motion.kind == "trolley") continue;
    ends.push_back(motion.ended);
    EXPECT_EQ(motion.why, motion.ended == "arrived" ? "" : "told to");
  }
  ASSERT_GT(ends.size(), 6U);
  ends.resize(6);
  EXPECT_EQ(ends, (std::vector<std::string>{"aborted", "arrived", "refused", "cancelled", "arrived",
                                            "withheld"}));
  // Two in a row: home, and on from there.
  EXPECT_EQ(record_.motions[4].kind, "home");
  // A frame is taken wherever the arm stands.
  const auto views = [&](const MotionEvent& motion) {
    const double end_s = motion.start_s + motion.duration_s;
    return std::count_if(record_.views.begin(), record_.views.end(),
                         [&](const ViewEvent& view) { return std::abs(view.t_s - end_s) < 1e-6; });
  };
  EXPECT_EQ(views(record_.motions[0]), 1);
}

TEST_F(MissionTest, AnArmThatNeverArrivesEndsTheRun) {
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  StumblingArm arm(*ports.arm, std::vector<MotionEnd>(9, MotionEnd::aborted));
  ports.arm = &arm;
  const auto outcome = run(simulation, ports);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(
      outcome.error().message.find("3 motions in a row did not arrive; the last aborted: told to"),
      std::string::npos)
      << outcome.error().message;
  EXPECT_EQ(record_.motions.size(), 3U);
  EXPECT_TRUE(record_.interrupted);
}

TEST_F(MissionTest, AnArmThatIsNeverAllowedToMoveGoesThroughAllSegmentsAllTheSame) {
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  StumblingArm arm(*ports.arm, std::vector<MotionEnd>(999, MotionEnd::withheld));
  ports.arm = &arm;
  const auto outcome = run(simulation, ports);
  ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
  EXPECT_FALSE(record_.interrupted);
  EXPECT_EQ(record_.segments.size(), 2U);
}

TEST_F(MissionTest, AfterAProtectiveStopAPersonIsWaitedFor) {
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  StumblingArm arm(*ports.arm, {MotionEnd::stopped});
  ports.arm = &arm;
  SteeringDesk desk;
  int held = 0;
  SteeringPolicy person("person", [&](const SteeringPoint& at) {
    if (at.holding && ++held == 3) desk.say({SteeringWord::Kind::go_on, "person", "looked"});
    return SteeringWord::Kind::go_on;
  });
  SteeringTogether all;
  all.add(desk);
  all.add(person);
  steering_ = &all;
  ASSERT_TRUE(run(simulation, ports).has_value());
  EXPECT_FALSE(record_.interrupted);
  ASSERT_GE(record_.steering.size(), 2U);
  EXPECT_EQ(record_.steering[0].said, "wait_for_person");
  EXPECT_EQ(record_.steering[0].by, "arm");
  EXPECT_EQ(record_.steering[0].why, "stopped: told to");
  EXPECT_EQ(record_.steering[1].said, "go_on");
}

}  // namespace
}  // namespace canopeer
