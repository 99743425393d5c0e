// Whether poses make sense together with what was seen, and by themselves.
#include "canopeer/sensing/pose_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

/// How far a ray goes in a room of 4 × 3 × 5 m with a pillar in it.
double distance_in_room(const Vec3& from, const Vec3& direction) {
  double nearest = 1e9;
  const Vec3 half(2.0, 1.5, 2.5);
  for (int axis = 0; axis < 3; ++axis) {
    const double side = direction[axis] > 0.0 ? half[axis] : -half[axis];
    if (direction[axis] != 0.0) nearest = std::min(nearest, (side - from[axis]) / direction[axis]);
  }
  // The pillar: radius 0.3 m about the vertical (y) through x = 0.5, z = 1.
  const double ox = from.x() - 0.5, oz = from.z() - 1.0;
  const double a = direction.x() * direction.x() + direction.z() * direction.z();
  const double b = ox * direction.x() + oz * direction.z();
  const double root = b * b - a * (ox * ox + oz * oz - 0.09);
  if (root > 0.0) {
    const double way = (-b - std::sqrt(root)) / a;
    if (way > 0.0) nearest = std::min(nearest, way);
  }
  return nearest;
}

SeenFrom look(const Pose& T_world_camera) {
  SeenFrom seen{{}, T_world_camera};
  for (double down = -0.4; down < 0.4; down += 0.012) {
    for (double across = -0.5; across < 0.5; across += 0.012) {
      const Vec3 ray(across, down, 1.0);
      const double way =
          distance_in_room(T_world_camera.translation(), T_world_camera.linear() * ray);
      seen.points.push_back((way * ray).cast<float>());
    }
  }
  return seen;
}

Pose pose_at(const Vec3& position, const Vec3& axis, double angle) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  pose.translation() = position;
  return pose;
}

std::vector<FramePair> walk(double tilt = 0.3) {
  std::vector<FramePair> pairs;
  for (int i = 0; i < 5; ++i) {
    const Vec3 from(-0.5 + 0.1 * i, 0.1 * i, -1.0);
    const Vec3 axis(tilt, 1.0, 0.1 * i);
    pairs.push_back({look(pose_at(from, axis, 0.2 * i)),
                     look(pose_at(from + Vec3(0.3, 0.0, 0.1), axis, 0.2 * i + 0.35))});
  }
  return pairs;
}

/// The pairs as if their quaternions had been written with w first and read with w last.
std::vector<FramePair> misread(std::vector<FramePair> pairs) {
  for (auto& [a, b] : pairs) {
    for (SeenFrom* seen : {&a, &b}) {
      const Eigen::Quaterniond q(seen->T_world_sensor.linear());
      seen->T_world_sensor.linear() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).matrix();
    }
  }
  return pairs;
}

TEST(PoseCheck, RightPosesMakeFramesAgree) {
  const PoseVerdict verdict = judge_poses(walk());
  EXPECT_EQ(verdict.as_read.pairs, 5);
  EXPECT_GT(verdict.as_read.share, 0.9);
  EXPECT_FALSE(verdict.order_is_wrong());
  EXPECT_FALSE(verdict.poses_are_odd());
}

TEST(PoseCheck, QuaternionsWithWFirstAreFound) {
  const std::vector<FramePair> wrong = misread(walk());
  EXPECT_TRUE(with_w_first(wrong[2].a.T_world_sensor).isApprox(walk()[2].a.T_world_sensor));
  const PoseVerdict verdict = judge_poses(wrong);
  EXPECT_GT(verdict.w_first.share, 0.9);
  EXPECT_TRUE(verdict.order_is_wrong()) << verdict.as_read.share;
  EXPECT_FALSE(verdict.poses_are_odd()) << verdict.as_read.share;
}

TEST(PoseCheck, AnOrderThatIsSaidIsNotDoubted) {
  const PoseVerdict verdict = judge_poses(misread(walk()), true);
  EXPECT_FALSE(verdict.order_is_wrong());
  EXPECT_FALSE(verdict.left_handed());
  EXPECT_TRUE(verdict.poses_are_odd()) << verdict.as_read.share;
  EXPECT_FALSE(judge_poses(walk(), true).poses_are_odd());
}

TEST(PoseCheck, LeftHandedPosesAreFound) {
  std::vector<FramePair> pairs = walk(1.5);  // mirrored, a turn about y is the same
  for (auto& [a, b] : pairs) {
    for (SeenFrom* seen : {&a, &b}) {
      const Pose right = seen->T_world_sensor;
      seen->T_world_sensor = mirrored(right);
      EXPECT_TRUE(mirrored(seen->T_world_sensor).isApprox(right));
      EXPECT_NEAR(seen->T_world_sensor.linear().determinant(), 1.0, 1e-12);
    }
  }
  const PoseVerdict verdict = judge_poses(pairs);
  EXPECT_GT(verdict.mirrored.share, 0.9);
  EXPECT_TRUE(verdict.left_handed()) << verdict.as_read.share;
  EXPECT_FALSE(verdict.order_is_wrong());
}

TEST(PoseCheck, PosesOfAnotherFrameAreOdd) {
  std::vector<FramePair> pairs = walk();
  Pose body = Pose::Identity();  // x forward, y left, z up
  body.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  for (auto& [a, b] : pairs) {
    for (SeenFrom* seen : {&a, &b}) {
      seen->T_world_sensor.linear() = (seen->T_world_sensor * body.inverse()).linear();
    }
  }
  const PoseVerdict verdict = judge_poses(pairs);
  EXPECT_TRUE(verdict.poses_are_odd()) << verdict.as_read.share;
  EXPECT_FALSE(verdict.order_is_wrong());
  EXPECT_FALSE(verdict.left_handed());
}

TEST(PoseCheck, FramesWithoutACommonViewSayNothing) {
  const SeenFrom a = look(pose_at(Vec3::Zero(), Vec3::UnitY(), 0.0));
  const SeenFrom b = look(pose_at(Vec3::Zero(), Vec3::UnitY(), 3.0));
  EXPECT_FALSE(agreement(a, b));
  EXPECT_EQ(judge_poses({{a, b}}).as_read.pairs, 0);
  EXPECT_FALSE(judge_poses({}).order_is_wrong());
}

TEST(PoseCheck, PairsLieALittleApart) {
  std::vector<Pose> poses;
  for (int i = 0; i < 120; ++i) {
    poses.push_back(pose_at(Vec3(0.0101 * i, 0, 0), Vec3::UnitY(), 0.0001 * i));
  }
  const auto pairs = pairs_to_compare(poses, 5);
  ASSERT_EQ(pairs.size(), 5U);
  for (const auto& [a, b] : pairs) EXPECT_EQ(b - a, 20U);
  EXPECT_TRUE(pairs_to_compare({Pose::Identity(), Pose::Identity()}, 5).empty());
}

TEST(PoseCheck, MotionThatNoCameraMakesIsANotice) {
  const auto notices = [](double step_m, double step_s) {
    std::string text;
    for (int i = 0; i < 30; ++i) {
      text += std::to_string(step_s * i) + " " + std::to_string(step_m * i) + " 0 0 0 0 0 1\n";
    }
    PoseSource source{"poses.txt", "columns", false, {}};
    add_motion_notice(*Trajectory::parse(text, "poses.txt"), source);
    return source.notices;
  };
  EXPECT_TRUE(notices(0.03, 0.033).empty());
  ASSERT_EQ(notices(30.0, 0.033).size(), 1U);  // millimetres
  EXPECT_NE(notices(30.0, 0.033)[0].find("29 of 29 steps"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
