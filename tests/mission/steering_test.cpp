#include <gtest/gtest.h>

#include "canopeer/mission/steering_desk.h"

namespace canopeer {
namespace {

using Kind = SteeringWord::Kind;

TEST(SteeringDesk, HandsTheNextSegmentOverOnceHoldsAPauseAndKeepsAStop) {
  SteeringDesk desk;
  EXPECT_EQ(desk.ask({}).kind, Kind::go_on);
  desk.say({Kind::next_segment, "page", ""});
  EXPECT_EQ(desk.ask({}).kind, Kind::next_segment);
  EXPECT_EQ(desk.ask({}).kind, Kind::go_on);
  desk.say({Kind::pause, "page", ""});
  EXPECT_EQ(desk.ask({}).kind, Kind::pause);
  EXPECT_EQ(desk.ask({}).kind, Kind::pause);
  desk.say({Kind::go_on, "page", ""});
  EXPECT_EQ(desk.ask({}).kind, Kind::go_on);
  desk.say({Kind::stop, "service", "rain"});
  desk.say({Kind::go_on, "page", ""});
  EXPECT_EQ(desk.ask({}).kind, Kind::stop);
  EXPECT_EQ(desk.ask({}).why, "rain");
}

TEST(SteeringDesk, AWordThatComesBeforeTheOneBeforeWasAskedForIsNotLost) {
  SteeringDesk desk;
  desk.say({Kind::next_segment, "page", ""});
  desk.say({Kind::pause, "page", ""});
  EXPECT_EQ(desk.ask({}).kind, Kind::pause);
  desk.say({Kind::go_on, "page", ""});
  EXPECT_EQ(desk.ask({}).kind, Kind::next_segment);
  EXPECT_EQ(desk.ask({}).kind, Kind::go_on);
}

TEST(SteeringTogether, ANextSegmentDoesNotEndAnothersHoldAndIsKept) {
  SteeringDesk page;
  SteeringDesk trolley;
  SteeringTogether all;
  all.add(page);
  all.add(trolley);
  trolley.say({Kind::wait_for_person, "trolley", "push it to 2 m"});
  page.say({Kind::next_segment, "page", ""});
  EXPECT_EQ(all.ask({}).kind, Kind::wait_for_person);
  EXPECT_EQ(all.ask({}).kind, Kind::wait_for_person);
  trolley.say({Kind::go_on, "person", ""});
  EXPECT_EQ(all.ask({}).kind, Kind::next_segment);
  EXPECT_EQ(all.ask({}).kind, Kind::go_on);
}

TEST(SteeringTogether, AnyPersonMaySayThatTheArmCanGoOn) {
  SteeringDesk page;
  SteeringDesk service;
  SteeringTogether program;
  program.add(page);
  SteeringTogether all;
  all.add(program);
  all.add(service);
  page.say({Kind::go_on, "page", "long ago"});
  SteeringPoint stopped;
  stopped.needs_person = "a protective stop";
  EXPECT_EQ(all.ask(stopped).kind, Kind::wait_for_person);
  EXPECT_EQ(all.ask({}).why, "a protective stop");
  page.say({Kind::pause, "page", ""});
  EXPECT_EQ(all.ask({}).kind, Kind::wait_for_person);
  service.say({Kind::go_on, "service", ""});
  EXPECT_EQ(all.ask({}).kind, Kind::pause);
  page.say({Kind::go_on, "page", ""});
  EXPECT_EQ(all.ask({}).kind, Kind::go_on);
  SteeringTogether nobody;
  SteeringPolicy policy("never", [](const SteeringPoint&) { return Kind::go_on; });
  nobody.add(policy);
  EXPECT_EQ(nobody.ask(stopped).kind, Kind::go_on);
}

TEST(SteeringTogether, TheWordThatStopsMostCounts) {
  SteeringDesk page;
  SteeringDesk service;
  SteeringPolicy policy("never", [](const SteeringPoint&) { return Kind::go_on; });
  SteeringTogether all;
  for (Steering* one : {static_cast<Steering*>(&policy), static_cast<Steering*>(&page),
                        static_cast<Steering*>(&service)}) {
    all.add(*one);
  }
  EXPECT_EQ(all.ask({}).kind, Kind::go_on);
  page.say({Kind::pause, "page", ""});
  service.say({Kind::wait_for_person, "trolley", "push it to 2 m"});
  EXPECT_EQ(all.ask({}).by, "trolley");
  page.say({Kind::stop, "page", ""});
  EXPECT_EQ(all.ask({}).by, "page");
}

TEST(Steering, NamesAreThoseOfTheRecord) {
  EXPECT_EQ(steering_name(Kind::go_on), "go_on");
  EXPECT_EQ(steering_name(Kind::wait_for_person), "wait_for_person");
}

}  // namespace
}  // namespace canopeer
