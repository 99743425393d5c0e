// Whether pose and image of a run's frames agree, found from simulated frames of rows of plants.
#include "canopeer/sensing/frame_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <utility>

#include "canopeer/base/rng.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// From view to view before a row, a second at rest at each, as a mission goes.
class Journey {
 public:
  Journey(std::uint64_t seed, int views) {
    Rng rng(seed, 7);
    double y = -1.0, t = 0.0;
    for (int i = 0; i < views; ++i) {
      if (i % 6 == 5) y += 0.4;  // the next plants
      const Vec3 eye{rng.uniform(0.05, 0.3), y + rng.uniform(-0.2, 0.2), rng.uniform(0.8, 1.2)};
      const Vec3 target{0.75, y + rng.uniform(-0.1, 0.1), 1.0 + rng.uniform(-0.1, 0.1)};
      const Pose T = look_at(eye, target, rng.uniform(-0.4, 0.4));
      if (!stops_.empty()) {
        const double way = (T.translation() - stops_.back().T.translation()).norm();
        t += 1.0;
        begins_.push_back(t);
        t += std::max(0.8, 1.9 * way / 0.45);  // 0.45 m/s in the middle of the way
      }
      stops_.push_back({T, t});
    }
    end_s_ = t + 1.0;
  }
  struct Stop {
    Pose T;
    double arrives_s;
  };
  [[nodiscard]] const std::vector<Stop>& stops() const { return stops_; }
  [[nodiscard]] double leaves_s(std::size_t stop) const { return begins_[stop]; }
  [[nodiscard]] Pose at(double t) const {
    for (std::size_t i = 0; i < begins_.size(); ++i) {
      if (t <= begins_[i]) return stops_[i].T;
      if (t < stops_[i + 1].arrives_s) {
        const double s = (t - begins_[i]) / (stops_[i + 1].arrives_s - begins_[i]);
        const double share = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
        const Pose& a = stops_[i].T;
        const Pose& b = stops_[i + 1].T;
        Pose pose = Pose::Identity();
        pose.linear() = Eigen::Quaterniond(a.linear())
                            .slerp(share, Eigen::Quaterniond(b.linear()))
                            .toRotationMatrix();
        pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
        return pose;
      }
    }
    return stops_.back().T;
  }
  [[nodiscard]] CameraTwist twist(double t) const {
    return twist_between(at(t - 0.002), at(t + 0.002), 0.004);
  }

 private:
  std::vector<Stop> stops_;
  std::vector<double> begins_;
  double end_s_ = 0.0;
};

/// What is wrong with a camera, and how it is used.
struct Faults {
  double stamp_offset_s = 0.0;  ///< stamps are later than images by that
  double translation_m = 0.0;
  double rotation_rad = 0.0;
  bool moving = true;  ///< frames on the way
  double hz = 6.0;
};

class FrameAgreementTest : public ::testing::Test {
 protected:
  void travel(const Faults& faults, std::uint64_t seed, int views = 10) {
    RgbdSensorOptions options;
    options.intrinsics = CameraIntrinsics::from_fov(240, 180, 80.0 * kDegree);
    options.noise = sensor_noise_preset("d435");
    options.hand_eye_translation_m = faults.translation_m;
    options.hand_eye_rotation_rad = faults.rotation_rad;
    options.seed = seed;
    const RgbdSensor sensor(*renderer_, scene_, options);
    T_said_true_ = sensor.hand_eye_error();
    const Journey journey(seed, views);
    FrameSample sample;
    std::uint64_t number = 0;
    const auto take = [&](double t) {  // at true time t, with the pose of its stamp
      RgbdFrame frame = sensor.capture(journey.at(t), number++);
      frame.time_s = t + faults.stamp_offset_s;
      frame.T_world_camera = journey.at(frame.time_s);
      return frame;
    };
    const auto& stops = journey.stops();
    for (std::size_t i = 0; i < stops.size(); ++i) {
      sample.rests_from(stops[i].arrives_s);
      sample.add_still(take(stops[i].arrives_s + 0.1));
      if (i + 1 == stops.size()) break;
      sample.moves_from(journey.leaves_s(i));
      const double until = stops[i + 1].arrives_s;
      for (double t = journey.leaves_s(i) + 0.04; faults.moving && t < until;
           t += 1.0 / faults.hz) {
        const RgbdFrame frame = take(t);
        sample.add_moving(frame, journey.twist(frame.time_s));
      }
    }
    agreement_ = judge_agreement(sample);
    ASSERT_TRUE(agreement_.estimate) << agreement_.why_not;
  }
  [[nodiscard]] const HandEyeEstimate& estimate() const { return *agreement_.estimate; }
  /// Where 0.1 s was added to stamps already.
  [[nodiscard]] std::string said() const {
    return agreement_text(agreement_, {Pose::Identity(), 0.1});
  }
  [[nodiscard]] double miss_m() const {
    return (T_said_true_.translation() - estimate().T_said_true.translation()).norm();
  }
  [[nodiscard]] double miss_rad() const {
    return Eigen::AngleAxisd(
               Eigen::Matrix3d(T_said_true_.linear().transpose() * estimate().T_said_true.linear()))
        .angle();
  }

  const Scene scene_ = make_world(dense_1_world(), 1);
  const std::unique_ptr<Renderer> renderer_ = std::make_unique<Renderer>(scene_);
  Pose T_said_true_ = Pose::Identity();
  FrameAgreement agreement_;
};

TEST_F(FrameAgreementTest, StampsThatAreOffAreFound) {
  for (const double late_s : {0.01, 0.03, -0.06}) {
    travel({.stamp_offset_s = late_s}, 1);
    EXPECT_TRUE(estimate().time_wrong) << late_s;
    EXPECT_FALSE(estimate().hand_eye_wrong) << late_s;
    EXPECT_NEAR(estimate().time_offset_s, -late_s, 0.004);
  }
}

TEST_F(FrameAgreementTest, AMountingThatIsOffIsFound) {
  travel({.translation_m = 0.005}, 3);
  EXPECT_TRUE(estimate().hand_eye_wrong);
  EXPECT_FALSE(estimate().time_wrong);
  EXPECT_LT(miss_m(), 0.001);
  travel({.rotation_rad = kDegree}, 1);
  EXPECT_TRUE(estimate().hand_eye_wrong);
  EXPECT_FALSE(estimate().time_wrong);
  EXPECT_LT(miss_rad(), 0.1 * kDegree);
}

TEST_F(FrameAgreementTest, WhereAllIsRightNobodyIsAlarmed) {
  for (std::uint64_t seed = 3; seed < 6; ++seed) {
    travel({}, seed);
    EXPECT_FALSE(agreement_.wrong()) << seed;
    EXPECT_TRUE(agreement_.time_known()) << seed;
    EXPECT_NE(said().find("agree: "), std::string::npos) << said();
  }
}

TEST_F(FrameAgreementTest, FramesAtRestTellNothingOfStamps) {
  travel({.stamp_offset_s = 0.03, .moving = false}, 1);
  EXPECT_EQ(agreement_.moving, 0);
  EXPECT_FALSE(agreement_.wrong());
  EXPECT_FALSE(agreement_.time_known());
  EXPECT_NE(said().find("do not tell whether their stamps are right"), std::string::npos) << said();
}

TEST_F(FrameAgreementTest, SaysWhatToWrite) {
  travel({.stamp_offset_s = 0.03}, 1);
  EXPECT_NE(said().find(" too late by the clock of the poses: add -0.0"), std::string::npos)
      << said();
  EXPECT_NE(said().find("ros2.camera.time_offset_s: 0.0"), std::string::npos) << said();
}

}  // namespace
}  // namespace canopeer
