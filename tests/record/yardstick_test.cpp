#include "canopeer/record/yardstick.h"

#include <gtest/gtest.h>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

std::filesystem::path yardstick_file(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("yardstick_" + name + ".json");
}

Yardstick full_yardstick() {
  Yardstick y;
  y.mission = "dense_1";
  y.protocol = "tight10";
  y.world_seed = 18446744073709551615U;
  y.world_hash = "0123abcd";
  y.fruits_total = 137;
  y.ceiling_fruits = 135;
  y.ceiling_surface = 0.1 + 0.2;
  y.ceiling_views = 51'234'567'890;
  y.ceiling_seen_once = 1.0 / 3.0;
  y.cover_views_90 = 21;
  y.cover_views_100 = 43;
  y.clairvoyant = BestResult{132, 0.745, "clairvoyant", "1.2", 9101, "plan.json", {"a.b=1", "c=2"}};
  y.best_found = y.clairvoyant;
  y.best_auc = BestResult{130, 0.819, "vmp", "1.2", 9102, "", {}};
  y.sampled = UpperBound{136.5, 0.91, {{0.0, 3.0}, {10.0 / 3.0, 57.25}}, "knapsack"};
  y.certified = UpperBound{137.0, {}, {}, "ceiling"};
  return y;
}

Expected<Yardstick> read_back(const std::string& name, const std::string& text) {
  EXPECT_TRUE(write_file(yardstick_file(name), text));
  return read_yardstick(yardstick_file(name));
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = yardstick_json(full_yardstick());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Yardstick, ReadsBackEveryFieldItWrote) {
  const Yardstick y = full_yardstick();
  ASSERT_TRUE(write_yardstick(yardstick_file("full"), y));
  const Expected<Yardstick> read = read_yardstick(yardstick_file("full"));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(yardstick_json(*read), yardstick_json(y));
  EXPECT_EQ(read->world_seed, y.world_seed);
  EXPECT_EQ(read->ceiling_surface, y.ceiling_surface);
  EXPECT_EQ(read->ceiling_views, y.ceiling_views);
  EXPECT_EQ(read->clairvoyant->settings, y.clairvoyant->settings);
  EXPECT_EQ(read->best_auc->detected, 130);
  ASSERT_EQ(read->sampled->course.size(), 2U);
  EXPECT_EQ(read->sampled->course[1].t_s, 10.0 / 3.0);
  EXPECT_FALSE(read->certified->auc.has_value());
  EXPECT_EQ(read->certified->by, "ceiling");
}

TEST(Yardstick, WhatNobodyReckonedIsNull) {
  Yardstick y;
  y.mission = "scenario_1";
  const std::string text = yardstick_json(y);
  EXPECT_NE(text.find("\"ceiling_fruits\": null"), std::string::npos);
  EXPECT_NE(text.find("\"certified\": null"), std::string::npos);
  const Expected<Yardstick> read = read_back("empty", text);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_FALSE(read->clairvoyant.has_value());
  EXPECT_EQ(yardstick_json(*read), text);
}

TEST(Yardstick, UnknownKeysAreSkippedAndMissingPartsAreNull) {
  const Expected<Yardstick> read =
      read_back("unknown", R"({"later": [1], "mission": "m", "protocol": "own", "world_seed": 3,
        "world_hash": "", "fruits_total": 4, "ceiling_views": 0, "ceiling_seen_once": 0,
        "sampled": {"fruits": 4, "by": "ceiling", "more": {}}})");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->fruits_total, 4);
  EXPECT_FALSE(read->best_found.has_value());
  EXPECT_EQ(read->sampled->fruits, 4.0);
  EXPECT_TRUE(read->sampled->course.empty());
}

TEST(Yardstick, DamagedFilesAreErrorsWithFileAndKey) {
  const std::vector<std::pair<std::string, std::string>> damaged = {
      {changed("\"fruits_total\": 137", "\"fruits_total\": 1.5"), "'fruits_total' must be a whole"},
      {changed("\"fruits_total\": 137", "\"fruits_total\": -1"), "'fruits_total' must be a whole"},
      {changed("\"fruits_total\": 137", "\"fruits_total\": 5000000000"), "'fruits_total'"},
      {changed("\"mission\": \"dense_1\"", "\"mission\": 4"), "'mission' must be a text"},
      {changed("\"detected\": 132", "\"found\": 132"), "'clairvoyant.detected' is missing"},
      {changed("\"c=2\"", "7"), "'clairvoyant.settings[1]' must be a text"},
      {changed("\"fruits\": 57.25", "\"fruits\": null"), "'sampled.course[1].fruits' is missing"},
      {changed("\"auc\": 0.91", "\"auc\": \"much\""), "'sampled.auc' must be a number"},
      {"[]", "must be an object"},
      {"{\n  \"mission\": \n}", "line 3"},
      {"", "line 1"},
  };
  for (const auto& [text, says] : damaged) {
    const Expected<Yardstick> read = read_back("bad", text);
    ASSERT_FALSE(read.has_value()) << says;
    EXPECT_NE(read.error().message.find("yardstick_bad.json: "), std::string::npos);
    EXPECT_NE(read.error().message.find(says), std::string::npos) << read.error().message;
  }
}

TEST(Yardstick, AnyCutOfAFileIsAnError) {
  const std::string text = yardstick_json(full_yardstick());
  for (std::size_t size = 0; size + 2 < text.size(); size += 23) {
    EXPECT_FALSE(read_back("cut", text.substr(0, size)).has_value()) << size;
  }
}

}  // namespace
}  // namespace canopeer
