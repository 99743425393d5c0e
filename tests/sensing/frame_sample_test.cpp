#include "canopeer/sensing/frame_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

/// A camera that looks at a wall and swings before it: at rest each second, else on the way.
class SwingingCamera {
 public:
  static Pose at(double t) {
    Pose T = Pose::Identity();
    T.translation().x() = 0.1 * std::sin(2.0 * M_PI * t);
    T.linear() = Eigen::AngleAxisd(0.1 * std::sin(M_PI * t), Vec3::UnitY()).toRotationMatrix();
    return T;
  }
  static CameraTwist twist(double t) { return twist_between(at(t - 1e-4), at(t + 1e-4), 2e-4); }
  static RgbdFrame frame(double t) {
    RgbdFrame frame;
    frame.time_s = t;
    frame.intrinsics = CameraIntrinsics::from_fov(64, 48, 1.2);
    frame.depth = DepthImage(64, 48, 0.6F);
    frame.T_world_camera = at(t);
    return frame;
  }
  static void travel(FrameSample& sample, int from, int to, int hz = 20) {
    for (int i = from * hz; i < to * hz; ++i) {
      const double t = static_cast<double>(i) / hz;
      if (i % hz == 0) {
        sample.add_still(frame(t));
      } else {
        sample.add_moving(frame(t), twist(t));
      }
    }
  }
};

TEST(FrameSample, KeepsAFewFramesOfARunOfAnyLengthFromAllOverIt) {
  for (const int seconds : {5, 12, 60, 301}) {
    FrameSample sample;
    SwingingCamera::travel(sample, 0, seconds);
    const auto frames = sample.frames();
    EXPECT_LE(frames.size(), 60U);
    EXPECT_GE(frames.size(), 20U) << seconds;
    EXPECT_LT(frames.front().time_s, 0.25 * seconds);
    EXPECT_GT(frames.back().time_s, 0.7 * seconds);
    std::size_t moving = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      moving += frames[i].moving;
      if (i > 0) {
        EXPECT_LT(frames[i - 1].time_s, frames[i].time_s);
      }
    }
    EXPECT_GT(moving, frames.size() / 3);
    EXPECT_LT(moving, frames.size());
  }
}

TEST(FrameSample, GoesOnFromItsBytesAsIfNothingHadBeen) {
  FrameSample whole, part;
  SwingingCamera::travel(whole, 0, 40);
  SwingingCamera::travel(part, 0, 23);
  FrameSample rest;
  ASSERT_TRUE(read_state_bytes(state_bytes(part), rest));
  SwingingCamera::travel(rest, 23, 40);
  EXPECT_EQ(state_bytes(rest), state_bytes(whole));
}

TEST(FrameSample, LeavesOutFramesThatComeTooLateAndThoseThatShowNothing) {
  FrameSample sample;
  SwingingCamera::travel(sample, 0, 5);
  sample.add_moving(SwingingCamera::frame(2.0), {});
  RgbdFrame empty = SwingingCamera::frame(5.0);
  empty.depth = DepthImage(64, 48);
  sample.add_still(empty);
  for (const auto& frame : sample.frames()) EXPECT_LT(frame.time_s, 5.0);
}

TEST(PoseTrack, KnowsWhereTheCameraWasBetweenItsPoints) {
  std::vector<TrackPoint> points;
  for (double t = 0.0; t < 2.0; t += 0.1) {
    points.push_back({t, SwingingCamera::at(t), SwingingCamera::twist(t)});
  }
  const PoseTrack track(points);
  for (double t = 0.0; t < 1.9; t += 0.013) {
    const auto pose = track.at(t);
    ASSERT_TRUE(pose);
    const Pose miss = SwingingCamera::at(t).inverse() * *pose;
    EXPECT_LT(miss.translation().norm(), 1e-3) << t;
    EXPECT_LT(Eigen::AngleAxisd(Eigen::Matrix3d(miss.linear())).angle(), 1.5e-3) << t;
  }
  EXPECT_TRUE(track.at(-0.1));
  EXPECT_FALSE(track.at(-0.2));
  EXPECT_FALSE(track.at(2.2));
}

TEST(CoarseDepth, TakesTheMeanOfInverseDepthAndNothingAtEdges) {
  CameraIntrinsics k = CameraIntrinsics::from_fov(8, 4, 1.0);
  DepthImage depth(8, 4, 1.0F);
  depth.at(0, 0) = std::nanf("");  // one pixel of four is missing
  depth.at(4, 0) = 2.0F;           // an edge
  depth.at(0, 2) = depth.at(1, 2) = depth.at(0, 3) = 0.0F;
  depth.at(2, 2) = 1.04F;
  const CoarseDepth coarse = coarse_depth(k, depth, 2);
  EXPECT_EQ(coarse.depth.width(), 4);
  EXPECT_EQ(coarse.depth.height(), 2);
  EXPECT_DOUBLE_EQ(coarse.intrinsics.fx, k.fx / 2.0);
  EXPECT_FLOAT_EQ(coarse.depth.at(0, 0), 1.0F);
  EXPECT_EQ(coarse.depth.at(2, 0), 0.0F);
  EXPECT_EQ(coarse.depth.at(0, 1), 0.0F);
  EXPECT_FLOAT_EQ(coarse.depth.at(1, 1), 4.0F / (3.0F + 1.0F / 1.04F));
}

}  // namespace
}  // namespace canopeer
