#include "canopeer/import/sdf/sdf_numbers.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "canopeer/import/sdf/sdf_file.h"

namespace canopeer {
namespace {

/// What <sdf> with this inside says in its first child.
Expected<Pose> pose_of(const std::string& xml) {
  const auto file = SdfFile::parse("<sdf>\n" + xml + "</sdf>", "a.sdf");
  EXPECT_TRUE(file.has_value());
  return sdf_pose((*file)->root().child("pose"));
}

std::string error_of(const std::string& xml) {
  const auto pose = pose_of(xml);
  return pose ? "" : pose.error().message;
}

TEST(SdfNumbers, APoseTurnsAboutTheFixedAxesXFirst) {
  Rng rng(1, "poses");
  for (int round = 0; round < 1000; ++round) {
    const Vec3 p{rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9)};
    const Vec3 a{rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9)};
    std::string text;
    for (const double v : {p.x(), p.y(), p.z(), a.x(), a.y(), a.z()}) {
      text += " \t\n" + std::to_string(v);
    }
    const auto T = pose_of("<pose>" + text + "</pose>");
    ASSERT_TRUE(T.has_value()) << text;
    Pose expected(Eigen::Translation3d(p) * Eigen::AngleAxisd(a.z(), Vec3::UnitZ()) *
                  Eigen::AngleAxisd(a.y(), Vec3::UnitY()) *
                  Eigen::AngleAxisd(a.x(), Vec3::UnitX()));
    EXPECT_LT((T->matrix() - expected.matrix()).norm(), 2e-5) << text;  // six digits written
  }
}

TEST(SdfNumbers, DegreesAndQuaternionsArePosesToo) {
  const Pose turned(Eigen::Translation3d(1, 2, 3) *
                    Eigen::AngleAxisd(std::acos(-1.0) / 2, Vec3::UnitZ()));
  for (const std::string xml :
       {"<pose degrees='true'>1 2 3 0 0 90</pose>",
        "<pose degrees='true' rotation_format='euler_rpy'>1 2 3 0 0 90</pose>",
        "<pose rotation_format='quat_xyzw'>1 2 3 0 0 2 2</pose>"}) {
    const auto T = pose_of(xml);
    ASSERT_TRUE(T.has_value()) << T.error().message;
    EXPECT_LT((T->matrix() - turned.matrix()).norm(), 1e-12) << xml;
  }
}

TEST(SdfNumbers, NoPoseAndAnEmptyOneAreTheIdentity) {
  for (const std::string xml : {"", "<pose/>", "<pose> </pose>", "<pose><!-- 1 --></pose>"}) {
    const auto T = pose_of(xml);
    ASSERT_TRUE(T.has_value());
    EXPECT_TRUE(T->matrix().isIdentity(0.0));
  }
  EXPECT_TRUE(pose_of("<pose><!-- here -->1 2 3 0 0 0</pose>").has_value());
}

TEST(SdfNumbers, WhatIsNoPoseIsSaidWithItsLine) {
  for (const std::string text : {"1 2 3", "1 2 3 4 5", "1 2 3 4 5 6 7", "1 2 3 4 5 nan",
                                 "1 2 3 4 5 inf", "1 2 3 4 5 1e999", "1,2,3,4,5,6"}) {
    const std::string error = error_of("<pose>" + text + "</pose>");
    EXPECT_EQ(error,
              "a.sdf:2: <pose>: expected six numbers: x y z roll pitch yaw, found '" + text + "'");
  }
  EXPECT_NE(error_of("<pose rotation_format='quat_xyzw'>1 2 3 0 0 1</pose>").find("seven numbers"),
            std::string::npos);
  EXPECT_NE(error_of("<pose rotation_format='quat_xyzw'>1 2 3 0 0 0 0</pose>").find("length 1"),
            std::string::npos);
  EXPECT_NE(error_of("<pose rotation_format='matrix'>1</pose>").find("euler_rpy or quat_xyzw"),
            std::string::npos);
}

TEST(SdfNumbers, WhatIsNotGivenIsTheFallback) {
  const auto file =
      SdfFile::parse("<sdf><a>2.5</a><b/><v>1 2 3</v><w>\n1 2</w><x>one</x></sdf>", "a.sdf");
  ASSERT_TRUE(file.has_value());
  const SdfElement root = (*file)->root();
  EXPECT_EQ(sdf_number(root, "a", 7.0).value(), 2.5);
  EXPECT_EQ(sdf_number(root, "b", 7.0).value(), 7.0);
  EXPECT_EQ(sdf_number(root, "none", 7.0).value(), 7.0);
  EXPECT_EQ(sdf_vector(root, "v", Vec3::Zero()).value(), Vec3(1, 2, 3));
  EXPECT_EQ(sdf_vector(root, "none", Vec3::Ones()).value(), Vec3::Ones());
  EXPECT_EQ(sdf_vector(root, "w", Vec3::Zero()).error().message,
            "a.sdf:1: <w>: expected 3 numbers, found '1 2'");
  EXPECT_EQ(sdf_number(root, "x", 7.0).error().message,
            "a.sdf:2: <x>: expected a number, found 'one'");
}

}  // namespace
}  // namespace canopeer
