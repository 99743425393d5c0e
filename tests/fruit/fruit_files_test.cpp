#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "canopeer/base/atomic_file.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/fruit/fruits_json.h"
#include "canopeer/fruit/surface_files.h"
#include "canopeer/sensing/cloud_file.h"

namespace canopeer {
namespace {

std::filesystem::path temporary(const std::string& ending) {
  return std::filesystem::temp_directory_path() /
         (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
          "_canopeer" + ending);
}

FruitEstimate some_fruit() {
  FruitEstimate f;
  f.id = 7;
  f.centre = {0.1, -1.25, 0.9};
  f.semi_axes_m = {0.03, 0.031, 0.04};
  f.e1 = 0.75;
  f.e2 = 0.85;
  f.roll_pitch_yaw_rad = {0.1, -0.2, 1.5};
  f.volume_cm3 = 181.3;
  f.points = 812;
  f.confidence = 0.97;
  f.centre_sd_m = {0.001, 0.002, 0.003};
  f.volume_sd_cm3 = 11.5;
  f.rms_m = 0.0012;
  f.seen_share = 0.62;
  f.ripeness = PixelLabel::turning_fruit;
  f.color = {220, 90, 20};
  f.views = 12;
  f.first_seen_s = 3.25;
  f.last_seen_s = 61.5;
  f.place = RowPlace{"west", 'R', 1.05, 0.9};
  return f;
}

TEST(FruitsCsv, IsReadBackAsItWas) {
  std::vector<FruitEstimate> fruits = {some_fruit(), some_fruit()};
  fruits[1].place.reset();
  const auto path = temporary(".csv");
  ASSERT_TRUE(write_file(path, fruits_csv(fruits)).has_value());
  const auto read = read_fruits_csv(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(fruits_csv(*read), fruits_csv(fruits));
  EXPECT_EQ((*read)[0].place->row, "west");
  EXPECT_FALSE((*read)[1].place.has_value());
  EXPECT_EQ((*read)[0].ripeness, PixelLabel::turning_fruit);
  std::filesystem::remove(path);
}

TEST(FruitsCsv, OfOlderRunsKeepsDefaultsForWhatIsMissing) {
  const auto path = temporary(".csv");
  ASSERT_TRUE(write_file(path,
                         "id,x_m,y_m,z_m,a_m,b_m,c_m,e1,e2,roll_rad,pitch_rad,yaw_rad,volume_cm3,"
                         "points,confidence\n1,0,0,1,0.03,0.03,0.04,1,1,0,0,0,150,100,0.9\n")
                  .has_value());
  const auto read = read_fruits_csv(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ((*read)[0].views, 0);
  std::filesystem::remove(path);
}

TEST(FruitsJson, HasEveryFruitWithItsPlace) {
  std::vector<FruitEstimate> fruits = {some_fruit(), some_fruit()};
  fruits[1].place.reset();
  const auto json = nlohmann::json::parse(fruits_json(fruits));
  ASSERT_EQ(json["fruits"].size(), 2U);
  EXPECT_EQ(json["unit"], "m");
  EXPECT_EQ(json["fruits"][0]["place"]["row"], "west");
  EXPECT_TRUE(json["fruits"][1]["place"].is_null());
  EXPECT_NEAR(json["fruits"][0]["volume_cm3"].get<double>(), 181.3, 1e-9);
}

SurfaceMesh triangle() {
  SurfaceMesh mesh;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    SurfaceVertex v;
    v.surface = {p, Vec3::UnitZ()};
    v.color = {200, 40, 10};
    mesh.vertices.push_back(v);
    mesh.fruit.push_back(3);
  }
  mesh.triangles.push_back({0, 1, 2});
  return mesh;
}

TEST(SurfacePly, IsReadAsACloudWithFruitNumbers) {
  const auto path = temporary(".ply");
  SurfaceMesh mesh = triangle();
  mesh.fruit[1] = -1;
  ASSERT_TRUE(write_surface_ply(path, mesh).has_value());
  const auto read = read_cloud(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->cloud.points.size(), 3U);
  EXPECT_EQ(read->cloud.normals.size(), 3U);
  EXPECT_EQ(read->cloud.colors[0].r, 200);
  EXPECT_EQ(read->fruit, (std::vector<int>{3, -1, 3}));
  std::filesystem::remove(path);
}

TEST(SurfaceGlb, NamesItsFruitsAndHoldsWhatItSays) {
  const auto path = temporary(".glb");
  SurfaceMesh mesh = triangle();
  for (SurfaceVertex& v : mesh.vertices) v.surface.point += Vec3(0.1, 1.0 / 3.0, -0.7);
  ASSERT_TRUE(write_surface_glb(path, mesh).has_value());
  const auto bytes = read_file(path);
  ASSERT_TRUE(bytes.has_value());
  ASSERT_EQ(bytes->substr(0, 4), "glTF");
  std::uint32_t length = 0, json_length = 0;
  std::memcpy(&length, bytes->data() + 8, 4);
  std::memcpy(&json_length, bytes->data() + 12, 4);
  EXPECT_EQ(length, bytes->size());
  const auto json = nlohmann::json::parse(bytes->substr(20, json_length));
  EXPECT_EQ(json["nodes"][1]["name"], "fruit_3");
  EXPECT_EQ(json["accessors"][3]["count"], 3);
  const std::size_t binary = json["buffers"][0]["byteLength"];
  EXPECT_EQ(20 + json_length + 8 + (binary + 3) / 4 * 4, bytes->size());
  // Bounds are those of the numbers written, to the last bit (glTF 2.0, 3.6.2.5).
  float points[9];
  std::memcpy(points, bytes->data() + 20 + json_length + 8, sizeof points);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({points[axis], points[axis + 3], points[axis + 6]});
    EXPECT_EQ(json["accessors"][0]["min"][axis].get<double>(), double{low});
    EXPECT_EQ(json["accessors"][0]["max"][axis].get<double>(), double{high});
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace canopeer
