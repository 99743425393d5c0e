#include <gtest/gtest.h>

#include <cstdio>

#include "canopeer/base/atomic_file.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/sensing/cloud_file.h"
#include "program.h"

namespace canopeer {
namespace {

Superellipsoid pepper(const Vec3& centre) {
  Superellipsoid body;
  body.semi_axes_m = {0.034, 0.031, 0.039};
  body.e1 = body.e2 = 0.75;
  body.T_world_body.translation() = centre;
  return body;
}

const Vec3 kCentres[] = {Vec3(0.5, 0.0, 1.0), Vec3(0.5, 0.07, 1.0)};

PointCloud two_fruits() {
  PointCloud cloud;
  for (const Vec3& centre : kCentres) {
    for (const SurfacePoint& s : pepper(centre).surface_samples(3000)) {
      cloud.points.push_back(s.point.cast<float>());
      cloud.normals.push_back(s.normal.cast<float>());
      cloud.colors.push_back({200, 40, 10});
    }
  }
  return cloud;
}

/// The same as text: PLY, PCD or CSV.
std::string as_text(const PointCloud& cloud, const std::string& head, const char* separator,
                    double unit) {
  std::string text = head;
  for (const auto& p : cloud.points) {
    const Vec3 q = unit * p.cast<double>();
    char line[80];
    std::snprintf(line, sizeof line, "%.5f%s%.5f%s%.5f\n", q.x(), separator, q.y(), separator,
                  q.z());
    text += line;
  }
  return text;
}

class FruitFit : public ::testing::Test {
 protected:
  /// Fits and expects both fruits with their sizes.
  void expect_both(const std::filesystem::path& cloud, std::vector<std::string> options = {}) {
    const auto out = directory_ / (cloud.filename().string() + ".out");
    options.insert(options.begin(), {"fruit", "fit", cloud.string(), "--out", out.string()});
    const auto result = test::canopeer(options);
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* file : {"fruits.csv", "fruits.json", "fruits.ply", "fruits.svg"}) {
      EXPECT_TRUE(std::filesystem::exists(out / file)) << file;
    }
    const auto fruits = read_fruits_csv(out / "fruits.csv");
    ASSERT_TRUE(fruits.has_value());
    ASSERT_EQ(fruits->size(), 2U) << result.out;
    for (const Vec3& centre : kCentres) {
      double nearest = 1.0;
      for (const FruitEstimate& f : *fruits) {
        nearest = std::min(nearest, (f.centre - centre).norm());
        EXPECT_NEAR(f.volume_cm3 / (1e6 * pepper(centre).volume_m3()), 1.0, 0.08);
      }
      EXPECT_LT(nearest, 0.003);
    }
  }

  void expect_refused(const std::filesystem::path& cloud, const std::string& word) {
    const auto out = directory_ / "refused";
    const auto result = test::canopeer({"fruit", "fit", cloud.string(), "--out", out.string()});
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(cloud.filename().string()), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }

  [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& content) {
    EXPECT_TRUE(write_file(directory_ / name, content).has_value());
    return directory_ / name;
  }

  test::TemporaryDirectory directory_;
};

TEST_F(FruitFit, ReadsEveryFormatWithAndWithoutNormals) {
  const PointCloud cloud = two_fruits();
  ASSERT_TRUE(write_ply(directory_ / "binary.ply", cloud).has_value());
  expect_both(directory_ / "binary.ply");
  const std::string count = std::to_string(cloud.points.size());
  expect_both(file("text.ply", as_text(cloud,
                                       "ply\nformat ascii 1.0\nelement vertex " + count +
                                           "\nproperty float x\nproperty float y\nproperty float "
                                           "z\nend_header\n",
                                       " ", 1.0)));
  expect_both(file(
      "text.pcd",
      as_text(cloud,
              "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
                  "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA ascii\n",
              " ", 1.0)));
  expect_both(file("table.csv", as_text(cloud, "x_m,y_m,z_m\n", ",", 1.0)));
  expect_both(file("millimetres.csv", as_text(cloud, "", ",", 1000.0)), {"--unit", "mm"});
}

TEST_F(FruitFit, SaysWhatIsWrongWithACloud) {
  expect_refused(file("empty.csv", "x,y,z\n"), "empty");
  std::string nan = "x,y,z\n";
  for (int i = 0; i < 200; ++i) nan += "nan,nan,nan\n";
  expect_refused(file("nan.csv", nan), "none of the 200 points is finite");
  expect_refused(file("unit.csv", as_text(two_fruits(), "x,y,z\n", ",", 1000.0)), "metres");
  expect_refused(file("words.csv", "x,y,z\n1,2,three\n"), "words.csv:2");
  expect_refused(file("other.csv", "a,b\n1,2\n"), "x, y and z");
  expect_refused(directory_ / "missing.ply", "missing.ply");
  expect_refused(file("cloud.las", "LASF"), ".ply, .pcd or .csv");
}

}  // namespace
}  // namespace canopeer
