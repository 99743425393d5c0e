#include "canopeer/config/protocols.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/mission_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

Expected<MissionFile> ruled_mission(const std::string& lines, const Overrides& overrides = {}) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path path =
      fs::temp_directory_path() / (std::string("canopeer_rules_") + test->name() + ".yaml");
  EXPECT_TRUE(
      write_file(path, "robot: robot.yaml\nstops_travel_m: [0]\ncompute_table: free\n" + lines));
  auto mission = load_mission(path, overrides, {}, Registries::built_in());
  fs::remove(path);
  return mission;
}

std::string ruled_complaint(const std::string& lines, const Overrides& overrides = {}) {
  const auto mission = ruled_mission(lines, overrides);
  EXPECT_FALSE(mission.has_value()) << lines;
  return mission ? "" : mission.error().message;
}

TEST(Protocols, EachSetsEveryRuleAndLoads) {
  const std::vector<Protocol> all = protocols();
  std::set<std::string> keys;
  for (const auto& [key, value] : all.front().settings) keys.insert(key);
  EXPECT_EQ(keys.size(), 5U);
  std::set<std::string> names;
  for (const Protocol& protocol : all) {
    names.insert(protocol.name);
    std::set<std::string> its;
    for (const auto& [key, value] : protocol.settings) its.insert(key);
    EXPECT_EQ(its, keys) << protocol.name;
    const auto file = ruled_mission("", {{"protocol", protocol.name}});
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->mission.protocol, protocol.name);
  }
  EXPECT_EQ(names, (std::set<std::string>{"mission", "tight10", "tight20", "until_done", "views10",
                                          "zaenker2023"}));
}

TEST(Protocols, SayWhatTheirNamesPromise) {
  const MissionOptions paper = ruled_mission("protocol: zaenker2023\n")->mission;
  EXPECT_EQ(paper.segment_time_s, 60.0);
  EXPECT_EQ(paper.clock, MissionClock::paper);
  const MissionOptions tight = ruled_mission("protocol: tight20\n")->mission;
  EXPECT_EQ(tight.segment_time_s, 20.0);
  EXPECT_EQ(tight.clock, MissionClock::whole);
  EXPECT_FALSE(tight.shares_time);
  const MissionOptions views = ruled_mission("protocol: views10\n")->mission;
  EXPECT_EQ(views.segment_time_s, 0.0);
  EXPECT_EQ(views.max_views, 10);
  const MissionOptions done = ruled_mission("protocol: until_done\n")->mission;
  EXPECT_EQ(done.segment_time_s, 0.0);
  EXPECT_EQ(done.max_views, 0);
  EXPECT_TRUE(done.leave_when_done);
  const MissionOptions row = ruled_mission("protocol: mission\n")->mission;
  EXPECT_TRUE(row.shares_time);
  EXPECT_TRUE(row.leave_when_done);
  EXPECT_EQ(row.clock, MissionClock::whole);
}

TEST(Protocols, ComeBeforeTheMissionFileButNotBeforeWhoSetsTheSame) {
  const auto file = ruled_mission(
      "time_per_segment_s: 45\nclock: paper\nmax_views: 3\nframes: {on_the_way_hz: 15}\n",
      {{"protocol", "tight10"}});
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mission.segment_time_s, 10.0);
  EXPECT_EQ(file->mission.max_views, 0);
  EXPECT_EQ(file->mission.clock, MissionClock::whole);
  EXPECT_EQ(file->mission.on_the_way.hz, 15.0);  // no rule
  EXPECT_NE(file->settings_json.find(R"("time_per_segment_s": 10)"), std::string::npos);
  EXPECT_NE(file->settings_json.find(R"("protocol": "tight10")"), std::string::npos);
  for (const char* key : {"time_per_segment_s", "clock", "max_views"}) {
    const std::string said = ruled_complaint("", {{"protocol", "tight10"}, {key, "20"}});
    EXPECT_NE(said.find(std::string(key) + ": protocol 'tight10'"), std::string::npos) << said;
  }
}

TEST(Protocols, WithoutOneTheMissionsOwnRulesHold) {
  const auto file = ruled_mission("max_views: 4\ntime_per_segment_s: 0\nleave_when_done: true\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mission.protocol, "");
  EXPECT_EQ(file->mission.max_views, 4);
  EXPECT_EQ(file->mission.segment_time_s, 0.0);
  EXPECT_TRUE(ruled_mission("protocol: own\ntime_per_segment_s: 7\n"));
  EXPECT_NE(file->settings_json.find(R"("protocol": "own")"), std::string::npos);
}

TEST(Protocols, MistakesAreToldTheNearest) {
  const std::string typo = ruled_complaint("protocol: tigth10\n");
  EXPECT_NE(typo.find(".yaml:4"), std::string::npos) << typo;
  EXPECT_NE(typo.find("did you mean 'tight10'?"), std::string::npos) << typo;
  EXPECT_NE(typo.find("until_done"), std::string::npos) << typo;
  EXPECT_NE(ruled_complaint("protocol: tight\n").find("tight10 and tight20"), std::string::npos);
  EXPECT_NE(ruled_complaint("time_per_segment_s: 0\n").find("max_views or leave_when_done"),
            std::string::npos);
  EXPECT_NE(ruled_complaint("time_per_segment_s: 0.5\n").find("1 or more"), std::string::npos);
  EXPECT_NE(ruled_complaint("time_per_segment_s: 0\nmax_views: 3\nclock: whole\n").find("clock"),
            std::string::npos);
  EXPECT_NE(ruled_complaint("shares_time: true\n").find("clock: whole"), std::string::npos);
}

TEST(Protocols, ListsMayNameTwoAtOnce) {
  EXPECT_EQ(*expand_protocols({"tight", "views10"}),
            (std::vector<std::string>{"tight10", "tight20", "views10"}));
  EXPECT_NE(expand_protocols({"view10"}).error().message.find("'views10'"), std::string::npos);
  EXPECT_TRUE(expand_protocols({})->empty());
}

TEST(LabelsRightTo70, AreANoiseAndGoByLabels) {
  const auto file = ruled_mission("noise: labels_70\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->simulation.sensor.label_noise, 0.3);
  EXPECT_EQ(file->mission.detector.kind, "labels");
  EXPECT_EQ(file->simulation.sensor.noise.disparity_noise_px, 0.0);
  EXPECT_NE(ruled_complaint("noise: labels_70\ndetector: {kind: colour}\n").find("detector.kind"),
            std::string::npos);
}

}  // namespace
}  // namespace canopeer
