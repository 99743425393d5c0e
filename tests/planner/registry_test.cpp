#include "canopeer/planner/registry.h"

#include <gtest/gtest.h>

#include "planner_fixture.h"

namespace canopeer {
namespace {

/// The least a planner from outside needs.
class Sleeper : public Planner {
 public:
  explicit Sleeper(std::string dream) : dream_(std::move(dream)) {}
  void begin_segment(const PlanningScene&) override {}
  Decision decide(const Configuration&, WorkMeter&) override { return {}; }
  [[nodiscard]] const std::string& dream() const { return dream_; }

 private:
  std::string dream_;
};

PlannerRegistry with_sleeper() {
  PlannerRegistry planners = PlannerRegistry::built_in();
  EXPECT_TRUE(planners.add("sleeper_2", "waits",
                           [](const PlannerOptions& o) -> Expected<std::unique_ptr<Planner>> {
                             const auto dream = o.own.find("dream");
                             if (dream == o.own.end()) return fail("'dream' is missing");
                             return std::make_unique<Sleeper>(dream->second);
                           }));
  return planners;
}

TEST(PlannerRegistry, MakesEveryPlannerItListsAndSaysALineAboutIt) {
  const PlannerRegistry planners = PlannerRegistry::built_in();
  for (const auto& name : planners.names()) {
    EXPECT_TRUE(planners.make(name, test::options_for_all()).has_value()) << name;
    EXPECT_FALSE(planners.one_line(name).empty()) << name;
  }
}

TEST(PlannerRegistry, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const auto planner = with_sleeper().make("vpm", {});
  ASSERT_FALSE(planner.has_value());
  EXPECT_NE(planner.error().message.find("'vpm'"), std::string::npos);
  EXPECT_NE(planner.error().message.find("vmp, "), std::string::npos);
  EXPECT_NE(planner.error().message.find(", sleeper_2"), std::string::npos);
}

TEST(PlannerRegistry, APlannerFromOutsideIsMadeWithItsOwnOptions) {
  const PlannerRegistry planners = with_sleeper();
  EXPECT_EQ(planners.names().back(), "sleeper_2");
  EXPECT_EQ(planners.one_line("sleeper_2"), "waits");
  PlannerOptions options;
  options.own["dream"] = "red fruits";
  const auto planner = planners.make("sleeper_2", options);
  ASSERT_TRUE(planner.has_value());
  EXPECT_EQ(dynamic_cast<const Sleeper&>(**planner).dream(), "red fruits");
}

TEST(PlannerRegistry, KnowsWhoDrivesAlongTheRow) {
  PlannerRegistry planners = PlannerRegistry::built_in();
  EXPECT_TRUE(planners.add(
      "tractor", "", [](const PlannerOptions&) { return std::make_unique<Sleeper>(""); },
      PlannerManners{true, false}));
  EXPECT_FALSE(planners.add(
      "vmp", "", [](const PlannerOptions&) { return std::make_unique<Sleeper>(""); },
      PlannerManners{true, false}));
  for (const auto& name : planners.names()) {
    const bool drives = name == "drive_by" || name == "tractor";
    EXPECT_EQ(planners.manners(name).drives_along_row, drives) << name;
    EXPECT_EQ(planners.manners(name).keeps_sharp, name == "drive_by" || name == "sweep") << name;
  }
  EXPECT_FALSE(planners.manners("vpm").drives_along_row);
}

TEST(PlannerRegistry, AFactorysErrorIsPassedOn) {
  const auto planner = with_sleeper().make("sleeper_2", {});
  ASSERT_FALSE(planner.has_value());
  EXPECT_EQ(planner.error().message, "planner 'sleeper_2': 'dream' is missing");
}

TEST(PlannerRegistry, RefusesNamesThatAreTakenOrNone) {
  PlannerRegistry planners = with_sleeper();
  const auto factory = [](const PlannerOptions&) { return std::make_unique<Sleeper>(""); };
  for (const char* name : {"vmp", "sleeper_2", "", "Sleeper", "my planner", "my-planner"}) {
    const auto added = planners.add(name, "", factory);
    ASSERT_FALSE(added.has_value()) << name;
    EXPECT_NE(added.error().message.find("'" + std::string(name) + "'"), std::string::npos);
  }
  EXPECT_EQ(planners.names(), with_sleeper().names());
}

TEST(Planner, WithoutOverridesItWaitsShowsNothingAndHasNoState) {
  Sleeper planner("");
  WorkMeter work;
  planner.map_changed({});
  planner.grow(1.0, work);
  EXPECT_EQ(planner.next_task(), nullptr);
  EXPECT_EQ(planner.status().graph_nodes, 0);
  EXPECT_TRUE(planner.sketch().views.empty());
  EXPECT_FALSE(planner.state().has_value());
  EXPECT_FALSE(planner.restore({}, "").has_value());
}

TEST(PlannerRegistry, SaysWhoseFactoryMadeNone) {
  PlannerRegistry planners = PlannerRegistry::built_in();
  ASSERT_TRUE(planners
                  .add("ghost", "",
                       [](const PlannerOptions&) -> Expected<std::unique_ptr<Planner>> {
                         return std::unique_ptr<Planner>();
                       })
                  .has_value());
  const auto made = planners.make("ghost", {});
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("planner 'ghost'"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
