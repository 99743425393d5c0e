#include "canopeer/import/sdf/sdf_population.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/import/sdf/sdf_file.h"

namespace canopeer {
namespace {

Expected<std::vector<Vec3>> places_of(const std::string& inside, const std::string& name = "p") {
  const auto file =
      SdfFile::parse("<sdf><population name='" + name + "'>" + inside + "</population></sdf>", "a");
  EXPECT_TRUE(file.has_value());
  return population_places((*file)->root().child("population"));
}

std::string distribution(const std::string& type) {
  return "<distribution><type>" + type + "</type></distribution>";
}

const std::string kBox = "<box><size>4 6 2</size></box><model_count>8</model_count>";
const std::string kCylinder =
    "<cylinder><radius>2</radius><length>3</length></cylinder><model_count>200</model_count>";

TEST(SdfPopulation, AGridStandsAboutItsMiddle) {
  const auto places = places_of(
      "<distribution><type>grid</type><rows>2</rows><cols>3</cols><step>1 2 0</step>"
      "</distribution>");
  ASSERT_TRUE(places.has_value()) << places.error().message;
  const std::vector<Vec3> expected = {{-1, -1, 0}, {0, -1, 0}, {1, -1, 0},
                                      {-1, 1, 0},  {0, 1, 0},  {1, 1, 0}};
  EXPECT_EQ(*places, expected);
}

TEST(SdfPopulation, LinesStartAtTheEdgeOfTheBox) {
  for (const int axis : {0, 1, 2}) {
    const auto places = places_of(kBox + distribution(std::string("linear-") + "xyz"[axis]));
    ASSERT_TRUE(places.has_value());
    ASSERT_EQ(places->size(), 8U);
    const double length = Vec3(4, 6, 2)[axis];
    for (std::size_t i = 0; i < 8; ++i) {
      Vec3 expected = Vec3::Zero();
      expected[axis] = length * (static_cast<double>(i) / 8.0 - 0.5);
      EXPECT_LT(((*places)[i] - expected).norm(), 1e-12);
    }
  }
}

TEST(SdfPopulation, DrawnPlacesLieInTheRegionAndAreTheSameEachTime) {
  for (const std::string type : {"random", "uniform"}) {
    const auto box = places_of(kBox + distribution(type));
    ASSERT_TRUE(box.has_value());
    ASSERT_EQ(box->size(), 8U);
    for (const Vec3& p : *box) {
      EXPECT_LE((p.cwiseAbs() - Vec3(2, 3, 1)).maxCoeff(), 0.0) << p.transpose();
    }
    const auto cylinder = places_of(kCylinder + distribution(type));
    ASSERT_TRUE(cylinder.has_value());
    ASSERT_EQ(cylinder->size(), 200U);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : *cylinder) {
      EXPECT_LE(p.head<2>().norm(), 2.0);
      EXPECT_GE(p.z(), 0.0);
      EXPECT_LE(p.z(), 3.0);
      sum += p / 200.0;
    }
    EXPECT_LT((sum - Vec3(0, 0, 1.5)).norm(), 0.5) << sum.transpose();
    EXPECT_EQ(*cylinder, *places_of(kCylinder + distribution(type)));
    EXPECT_NE(*cylinder, *places_of(kCylinder + distribution(type), "other"));
  }
}

TEST(SdfPopulation, UniformPlacesKeepApart) {
  const auto places = places_of("<box><size>1 1 0</size></box><model_count>100</model_count>" +
                                distribution("uniform"));
  ASSERT_TRUE(places.has_value());
  double nearest = 1.0;
  for (std::size_t i = 0; i < places->size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      nearest = std::min(nearest, ((*places)[i] - (*places)[k]).norm());
    }
  }
  EXPECT_GT(nearest, 0.04);  // of random ones some 0.005
}

TEST(SdfPopulation, WhatIsWrongIsSaid) {
  const auto error = [](const std::string& inside) {
    const auto places = places_of(inside);
    return places ? std::string() : places.error().message;
  };
  EXPECT_NE(error("<model_count>3</model_count>").find("<box> or a <cylinder>"), std::string::npos);
  EXPECT_NE(error(kBox + distribution("heap")).find("expected random, uniform, grid"),
            std::string::npos);
  for (const std::string count : {"0", "-1", "10001"}) {
    EXPECT_NE(error("<model_count>" + count + "</model_count>").find("expected 1 … 10000"),
              std::string::npos);
  }
  EXPECT_NE(error("<distribution><type>grid</type><rows>1000</rows><cols>1000</cols>"
                  "</distribution>")
                .find("at most 10000"),
            std::string::npos);
}

}  // namespace
}  // namespace canopeer
