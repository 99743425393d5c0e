#include "canopeer/view/pace.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

double seconds_for(Pace& pace, double t_s) {
  const auto begin = std::chrono::steady_clock::now();
  SteeringPoint point;
  point.t_s = t_s;
  EXPECT_EQ(pace.ask(point).kind, SteeringWord::Kind::go_on);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(Pace, HoldsTheMissionBackToItsSpeed) {
  Pace pace([] { return false; });
  seconds_for(pace, 1e6);  // no speed is set: no waiting, or this would never end
  pace.set(100.0);
  seconds_for(pace, 1e6);  // counts from here
  EXPECT_GE(seconds_for(pace, 1e6 + 20.0), 0.15);
}

TEST(Pace, GivesUpForAMissionThatIsToStop) {
  bool stop = false;
  Pace pace([&] { return std::exchange(stop, true); });
  pace.set(1.0);
  seconds_for(pace, 0.0);
  EXPECT_LT(seconds_for(pace, 1e9), 1e6);
}

}  // namespace
}  // namespace canopeer
