#include "canopeer/config/yaml_reader.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

YamlMap parse(const std::string& text) {
  auto map = YamlMap::parse(text, "m.yaml");
  EXPECT_TRUE(map) << map.error().message;
  return *map;
}

std::string complaint(const YamlMap& map) {
  const auto done = map.finish();
  return done ? "" : done.error().message;
}

TEST(YamlMap, ReadsEveryKindOfValue) {
  YamlMap map = parse(
      "time_s: 60\ncount: 3\non: true\nname: scenario\nkind: fast\n"
      "box: {x_m: [0, 1.5]}\nplants:\n  - {id: 4}\n  - {id: 9}\nnames: [a, b]\n");
  EXPECT_EQ(map.number("time_s", 1.0), 60.0);
  EXPECT_EQ(map.integer("count", 1), 3);
  EXPECT_TRUE(map.boolean("on", false));
  EXPECT_EQ(map.text("name", ""), "scenario");
  EXPECT_EQ(map.choice("kind", "slow", {"slow", "fast"}), "fast");
  EXPECT_EQ(map.map("box").required_numbers("x_m", 2), (std::vector<double>{0.0, 1.5}));
  std::vector<int> ids;
  for (YamlMap& plant : map.maps("plants")) ids.push_back(plant.required_integer("id"));
  EXPECT_EQ(ids, (std::vector<int>{4, 9}));
  EXPECT_EQ(map.texts("names", {}), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(map.number("absent", 7.0), 7.0);
  EXPECT_EQ(complaint(map), "");
}

TEST(YamlMap, NamesAnUnknownKeyAndTheNearestKnownOne) {
  YamlMap map = parse("seed: 1\ntime_per_segment_min: 1\n");
  map.integer("seed", 0);
  map.required_number("time_per_segment_s");
  EXPECT_EQ(complaint(map),
            "m.yaml:2: unknown key 'time_per_segment_min'; did you mean 'time_per_segment_s'?");
}

TEST(YamlMap, FindsUnknownKeysInInnerMappings) {
  YamlMap map = parse("camera:\n  width_px: 640\n  fov_deg: 80\n");
  map.map("camera").integer("width_px", 0);
  map.map("camera").number("fov_x_deg", 80.0);
  EXPECT_EQ(complaint(map), "m.yaml:3: unknown key 'fov_deg'; did you mean 'fov_x_deg'?");
}

TEST(YamlMap, SaysWhatWasExpected) {
  YamlMap unit = parse("a: 1\ntime_s: 60 s\n");
  unit.integer("a", 0);
  EXPECT_EQ(unit.number("time_s", 5.0, {1.0, 100.0}), 5.0);
  EXPECT_EQ(complaint(unit),
            "m.yaml:2: time_s: expected a number in seconds between 1 and 100, found '60 s'");
  YamlMap range = parse("time_s: 0\n");
  range.number("time_s", 5.0, {1.0});
  EXPECT_EQ(complaint(range),
            "m.yaml:1: time_s: expected a number in seconds of at least 1, found '0'");
  YamlMap whole = parse("k: 2.5\n");
  whole.integer("k", 5);
  EXPECT_EQ(complaint(whole), "m.yaml:1: k: expected a whole number, found '2.5'");
  YamlMap length = parse("x_m: [1, 2, 3]\n");
  length.numbers("x_m", {}, 2);
  EXPECT_EQ(complaint(length),
            "m.yaml:1: x_m: expected a sequence of 2 numbers in metres, found a sequence of 3");
  YamlMap choice = parse("planner: vpm\n");
  choice.choice("planner", "vmp", {"vmp", "rvp"});
  EXPECT_EQ(complaint(choice), "m.yaml:1: planner: expected one of vmp, rvp, found 'vpm'");
  YamlMap missing = parse("a: 1\n");
  missing.integer("a", 0);
  missing.required_text("urdf");
  EXPECT_EQ(complaint(missing), "m.yaml:1: key 'urdf' is missing");
}

TEST(YamlMap, ReportsBrokenYamlWithItsLine) {
  const auto broken = YamlMap::parse("a: 1\nb: [1, 2\nc: 3\n", "m.yaml");
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("m.yaml:"), std::string::npos) << broken.error().message;
  const auto twice = YamlMap::parse("a: 1\na: 2\n", "m.yaml");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().message, "m.yaml:2: key 'a' is there twice; the first is on line 1");
  EXPECT_FALSE(YamlMap::parse("- 1\n- 2\n", "m.yaml"));
  EXPECT_FALSE(YamlMap::parse("", "m.yaml"));
  EXPECT_FALSE(YamlMap::load("/nonexistent/m.yaml"));
}

std::string error_of(const std::string& text) {
  const auto map = YamlMap::parse(text, "m.yaml");
  return map ? "no error" : map.error().message;
}

TEST(YamlMap, ASecondDocumentIsNotPassedOver) {
  EXPECT_EQ(error_of("a: 1\n---\nb: 2\n"),
            "m.yaml:3: a second document begins here (after ---); a file must hold one");
  EXPECT_EQ(error_of("--- # first\na: 1\n...\n---\n- 1\n"),
            "m.yaml:5: a second document begins here (after ---); a file must hold one");
  for (const char* one : {"---\na: 1\n", "a: 1\n...\n", "a: 1\n---\n", "%YAML 1.2\n---\na: 1\n",
                          "\xEF\xBB\xBF"
                          "a: 1\r\n"}) {
    EXPECT_EQ(error_of(one), "no error") << one;
  }
}

TEST(YamlMap, TheSameKeyTwiceIsFoundAtAnyDepth) {
  EXPECT_EQ(error_of("a: 1\nb:\n  c: 1\n  d: 2\n  c: 1\n"),
            "m.yaml:5: key 'c' is there twice; the first is on line 3");
  EXPECT_EQ(error_of("a: 1\nb: [{c: 1}, {c: 1, c: 2}]\n"),
            "m.yaml:2: key 'c' is there twice; the first is on line 2");
  EXPECT_EQ(error_of("a: 1\n'a': 2\n"), "m.yaml:2: key 'a' is there twice; the first is on line 1");
}

TEST(YamlMap, TabsThatIndentAreNamed) {
  const std::string tab = "a tab indents this line; YAML wants blanks";
  EXPECT_EQ(error_of("a:\n\tb: 1\n"), "m.yaml:2: " + tab);
  EXPECT_EQ(error_of("a: 1\n\tb: 2\n"), "m.yaml:2: " + tab);
  EXPECT_EQ(error_of("a:\n  b: 1\n\tc: 2\n"), "m.yaml:3: " + tab);
  EXPECT_EQ(error_of("a:\n  - b: 1\n \t  c: 2\n"), "m.yaml:3: " + tab);
  EXPECT_EQ(error_of("a:\t1\t# one\nb: [1,\n\t2]\n"), "no error");
}

TEST(YamlMap, AliasesThatNeverEndAreRefused) {
  const std::string alias = "an alias (*name) repeats what holds it, or too much";
  EXPECT_NE(error_of("a: &x [*x]\n").find(alias), std::string::npos);
  EXPECT_NE(error_of("a: &x {b: *x}\n").find(alias), std::string::npos);
  std::string laughs = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string of = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + of;
    for (int k = 0; k < 9; ++k) laughs += ", " + of;
    laughs += "]\n";
  }
  EXPECT_NE(error_of(laughs).find(alias), std::string::npos);
  EXPECT_EQ(error_of("a: &x {b: 1}\nc: *x\n"), "no error");
}

TEST(YamlMap, TakesSettingsFromOutside) {
  YamlMap map = parse("search: {depth: 3}\n");
  ASSERT_TRUE(map.set("search.depth", "7"));
  ASSERT_TRUE(map.set("camera.width_px", "320"));
  EXPECT_EQ(map.map("search").integer("depth", 0), 7);
  EXPECT_EQ(map.map("camera").integer("width_px", 0), 320);
  EXPECT_EQ(complaint(map), "");
  ASSERT_TRUE(map.set("serach.depth", "7"));
  EXPECT_EQ(complaint(map), "m.yaml (--set): unknown key 'serach'; did you mean 'search'?");
}

}  // namespace
}  // namespace canopeer
