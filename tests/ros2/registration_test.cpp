#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "canopeer/map/fusion.h"
#include "canopeer/render/renderer.h"
#include "canopeer/ros2/trolley/travel_registration.h"
#include "support/planning_fixture.h"

namespace canopeer::ros {
namespace {

using Kind = TravelRegistration::Kind;

/// The shipped robot at its first stop, whose home frame is mapped.
class Registration : public ::testing::Test {
 protected:
  /// What the camera sees when the trolley stands `beside_m` farther than is believed, arm at home.
  RgbdFrame frame_from(double beside_m) {
    TrolleyState there = fixture_.frame.trolley;
    const Pose believed = pose_at(there);
    there.travel_m += beside_m;
    RgbdFrame frame;
    RenderedView seen = renderer_.render(frame.intrinsics, pose_at(there));
    frame.depth = std::move(seen.depth);
    frame.color = std::move(seen.color);
    frame.T_world_camera = believed;
    return frame;
  }
  Pose pose_at(const TrolleyState& trolley) const {
    return fixture_.robot.T_world_base(trolley) * fixture_.robot.T_base_camera(fixture_.frame.home);
  }
  TravelRegistration registered(const RgbdFrame& frame) const {
    return register_travel(fixture_.perception.map(), frame, Vec3::UnitY());
  }

  test::PlanningFixture fixture_;
  Renderer renderer_{fixture_.scene};
};

TEST_F(Registration, SaysHowFarBesideTheTrolleyStands) {
  for (const double beside_m : {-0.12, -0.03, 0.0, 0.055, 0.15}) {
    const TravelRegistration found = registered(frame_from(beside_m));
    ASSERT_EQ(found.kind, Kind::clear) << beside_m << ": " << found.agreement;
    EXPECT_NEAR(found.shift_m, beside_m, 0.006);
    EXPECT_GE(found.agreement, found.agreement_unshifted);
  }
}

TEST_F(Registration, DoesNotBelieveWhatLiesBeyondItsReach) {
  EXPECT_NE(registered(frame_from(0.5)).kind, Kind::clear);
}

TEST_F(Registration, SaysWhenNothingIsMapped) {
  const VoxelMap empty;
  const TravelRegistration found = register_travel(empty, frame_from(0.0), Vec3::UnitY());
  EXPECT_EQ(found.kind, Kind::nothing_there);
  EXPECT_GT(found.points, 1000);
  EXPECT_NE(in_words(found, 1.0).find("nothing is mapped"), std::string::npos);
}

TEST_F(Registration, OfAFrameWithoutDepthSaysNothing) {
  RgbdFrame frame = frame_from(0.0);
  for (float& depth : frame.depth.pixels()) depth = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(registered(frame).kind, Kind::nothing_there);
  frame.depth = DepthImage();
  EXPECT_EQ(registered(frame).points, 0);
}

/// A wall along the row looks the same wherever the trolley stands.
TEST(TravelRegistration, OfAWallAlongTheRowIsUnclear) {
  RgbdFrame frame;
  frame.T_world_camera = Pose(Eigen::Translation3d(0.5, 2.0, 1.0) *
                              Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY()));
  frame.depth = DepthImage(frame.intrinsics.width, frame.intrinsics.height, 1.0F);
  VoxelMap map;
  Mask no_mask;
  RgbdFrame longer = frame;
  for (double y = 1.0; y <= 3.0; y += 0.2) {
    longer.T_world_camera.translation().y() = y;
    fuse(map, longer, no_mask);
  }
  const TravelRegistration found = register_travel(map, frame, Vec3::UnitY());
  EXPECT_EQ(found.kind, Kind::unclear);
  EXPECT_EQ(found.shift_m, 0.0);
  EXPECT_NE(in_words(found, 2.0).find("2.000 m is believed"), std::string::npos);
}

TEST(TravelRegistration, IsSaidInWords) {
  TravelRegistration found;
  found.kind = Kind::clear;
  found.shift_m = 0.034;
  found.agreement = 0.61;
  found.points = 3800;
  EXPECT_EQ(in_words(found, 2.4),
            "trolley: by the map it stands at travel 2.434 m, 34 mm beside what was believed (61 % "
            "of 3800 points agree, 0 % before)");
}

}  // namespace
}  // namespace canopeer::ros
