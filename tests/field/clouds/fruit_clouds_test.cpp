// One fruit as a table in every tongue: the same fruit.
#include <gtest/gtest.h>

#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/fruit/fruits_csv.h"
#include "inputs.h"
#include "program.h"

namespace canopeer {
namespace {

using test::input;

/// What `fruit fit` made of a file of `inputs/fruit/`.
struct Fitted {
  std::string csv;  ///< fruits.csv
  std::vector<FruitEstimate> fruits;
  std::string err;
};

Fitted fit(const std::string& name) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "out";
  const auto result =
      test::canopeer({"fruit", "fit", input("fruit/" + name).string(), "--out", out.string()});
  EXPECT_EQ(result.status, 0) << name << ": " << result.err;
  Fitted fitted{"", {}, result.err};
  if (result.status != 0) return fitted;
  fitted.csv = read_file(out / "fruits.csv").value_or("");
  fitted.fruits = read_fruits_csv(out / "fruits.csv").value();
  return fitted;
}

void expect_refused(const std::string& name, const std::string& words) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "out";
  const auto result =
      test::canopeer({"fruit", "fit", input("fruit/" + name).string(), "--out", out.string()});
  EXPECT_EQ(result.status, 2) << name << result.out;
  EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(FruitClouds, EveryTongueGivesTheSameFruit) {
  const Fitted plain = fit("plain.csv");
  ASSERT_EQ(plain.fruits.size(), 1U);
  EXPECT_LT((plain.fruits[0].centre - Vec3(0.5, 0.2, 1.1)).norm(), 0.002);
  EXPECT_NEAR(plain.fruits[0].volume_cm3, 177.7, 9.0);  // of an ellipsoid, 34 × 32 × 39 mm
  EXPECT_EQ(plain.fruits[0].ripeness, PixelLabel::background);
  EXPECT_TRUE(plain.err.empty()) << plain.err;
  for (const char* name : {"excel_bom.csv", "utf16.csv", "cloudcompare.asc", "hash_head.txt",
                           "pandas_index.csv", "quoted.csv", "decimal_comma.csv", "tabs.tsv",
                           "points.xyz", "counted.pts", "paraview.csv", "strays.csv"}) {
    EXPECT_EQ(fit(name).csv, plain.csv) << name;
  }
}

TEST(FruitClouds, StraysAreCounted) {
  const std::string err = fit("strays.csv").err;
  EXPECT_NE(err.find("notice: left out: 2 points that are not finite"), std::string::npos) << err;
  EXPECT_NE(err.find("notice: left out: 1 points beyond 2000 m"), std::string::npos) << err;
}

TEST(FruitClouds, ColoursOfEveryScaleTellRipeness) {
  const Fitted red = fit("red_to_255.csv");
  ASSERT_EQ(red.fruits.size(), 1U);
  EXPECT_EQ(red.fruits[0].ripeness, PixelLabel::ripe_fruit);
  EXPECT_TRUE(red.fruits[0].color == (Rgb{200, 40, 10}));
  for (const char* name :
       {"red_to_1.csv", "red_to_65535.csv", "red_capitals.ply", "red_capitals.pcd"}) {
    EXPECT_EQ(fit(name).csv, red.csv) << name;
  }
  EXPECT_EQ(fit("green.csv").fruits.at(0).ripeness, PixelLabel::green_fruit);
}

TEST(FruitClouds, WhatIsNoCloudIsRefusedInOneLine) {
  expect_refused("bad_commas.csv", "separate the columns by semicolons");
  expect_refused("bad_columns.csv", ":1: expected columns x, y and z, found east, north");
  expect_refused("bad_number.csv", ":3: expected a number, found 'O.2'");
  expect_refused("bad_cut.pts", "holds 330 of the 400 points");
  expect_refused("bad_pointer.ply", "a Git LFS pointer");
}

}  // namespace
}  // namespace canopeer
