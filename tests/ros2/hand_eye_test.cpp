// Errors of mounting and clock, found from simulated frames in front of a row of plants.
#include "canopeer/sensing/hand_eye.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "canopeer/config/robot_file.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/ros2/camera/frame_poses.h"
#include "canopeer/scene/worlds.h"

namespace canopeer::ros {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const RobotModel& robot() {
  static const RobotModel model =
      *load_robot(std::string(CANOPEER_SOURCE_DIR) + "/robots/ur5e_trolley/robot.yaml");
  return model;
}

/// A UR5e in front of a row: its joints in time, and what its camera sees.
class HandEyeTest : public ::testing::Test {
 protected:
  /// The arm looks about, standing in eight places for a second each, then swings for four seconds.
  static Configuration joints_at(double t) {
    Configuration q = robot().home("side_1");
    const auto about = [](int place) {
      constexpr double kTurns[8][4] = {{0, 0, 0, 0},      {0.2, 0, 0, 0},      {0, 0.2, 0, 0.2},
                                       {0, 0, 0.25, 0},   {-0.2, 0.1, 0, 0.4}, {0.1, -0.2, -0.2, 0},
                                       {0, 0.1, 0, -0.5}, {-0.1, 0, -0.2, 0.3}};
      Eigen::Vector4d turn;
      for (int i = 0; i < 4; ++i) turn[i] = kTurns[place][i];
      return turn;
    };
    Eigen::Vector4d turn = Eigen::Vector4d::Zero();
    if (t < 8.0) {
      const int place = static_cast<int>(t);
      const double share = std::min(1.0, 4.0 * (t - place));
      turn = (1.0 - share) * about(std::max(0, place - 1)) + share * about(place);
    } else {
      const double s = std::sin(1.2 * (t - 8.0));
      turn = Eigen::Vector4d(0.2 * s, 0.1 * std::sin(2.0 * (t - 8.0)), 0.15 * s, 0.2 * s);
    }
    q[0] += turn[0];
    q[3] += turn[1];
    q[4] += turn[2];
    q[5] += turn[3];
    return q;
  }

  /// Frames as they would come: the camera sits at T_said_true, its clock is behind by `offset_s`.
  void look(double offset_s, bool moving = true) {
    const RgbdSensor sensor(*renderer_, scene_, options_);
    T_said_true_ = sensor.hand_eye_error();
    frames_.clear();
    const auto take = [&](double t) {
      const RgbdFrame frame = sensor.capture(
          robot().T_world_base(trolley_) * robot().T_base_camera(joints_at(t)), frames_.size());
      frames_.push_back({t - offset_s, frame.intrinsics, frame.depth});
    };
    for (int place = 0; place < 8; ++place) take(place + 0.8);
    for (double t = 8.1; moving && t < 12.0; t += 0.45) take(t);
    JointHistory joints(robot().setup().arm_joints, 100.0);
    for (double t = 0.0; t < 13.0; t += 0.01) {
      const Configuration q = joints_at(t);
      for (int j = 0; j < robot().dof(); ++j) joints.add(j, {nanoseconds(t), q[j]});
    }
    const auto poses = poses_of_joints(robot(), joints, [this](Stamp) { return trolley_; });
    estimate_ = estimate_hand_eye(frames_, [&](double t) -> std::optional<Pose> {
      const auto pose = poses->at(nanoseconds(t), "");
      if (!pose) return std::nullopt;
      return *pose;
    });
    ASSERT_TRUE(estimate_) << estimate_.error().message;
  }

  /// How far the mounting that was found is from where the camera sits.
  [[nodiscard]] double miss_m() const {
    return (T_said_true_.translation() - estimate_->T_said_true.translation()).norm();
  }
  [[nodiscard]] double miss_rad() const {
    return Eigen::AngleAxisd(
               Eigen::Matrix3d(T_said_true_.linear().transpose() * estimate_->T_said_true.linear()))
        .angle();
  }
  void print(const char* what) const {
    std::printf(
        "%s: found %.1f mm (se %.1f), %.2f deg (se %.2f), %.1f ms (se %.1f); off by %.2f mm, %.3f "
        "deg; residual %.2f -> %.2f mm\n",
        what, 1e3 * estimate_->translation_m, 1e3 * estimate_->translation_se_m,
        estimate_->rotation_rad / kDegree, estimate_->rotation_se_rad / kDegree,
        1e3 * estimate_->time_offset_s, 1e3 * estimate_->time_offset_se_s, 1e3 * miss_m(),
        miss_rad() / kDegree, 1e3 * estimate_->all.before_m, 1e3 * estimate_->all.after_m);
  }

  const Scene scene_ = make_world(scenario_1_world(), 1);
  const std::unique_ptr<Renderer> renderer_ = std::make_unique<Renderer>(scene_);
  const TrolleyState trolley_{1.0, 0.0};
  RgbdSensorOptions options_ = [] {
    RgbdSensorOptions options;
    options.intrinsics = CameraIntrinsics::from_fov(320, 240, 80.0 * kDegree);
    options.noise = sensor_noise_preset("d435");
    return options;
  }();
  Pose T_said_true_ = Pose::Identity();
  std::vector<HandEyeFrame> frames_;
  Expected<HandEyeEstimate> estimate_ = fail("nothing yet");
};

TEST_F(HandEyeTest, WhereAllIsRightNothingIsCalledWrong) {
  look(0.0);
  print("right");
  EXPECT_TRUE(estimate_->hand_eye_known);
  EXPECT_TRUE(estimate_->time_known);
  EXPECT_FALSE(estimate_->hand_eye_wrong);
  EXPECT_FALSE(estimate_->time_wrong);
}

TEST_F(HandEyeTest, AMountingThatIsOffIsFound) {
  options_.hand_eye_translation_m = 0.02;
  options_.hand_eye_rotation_rad = 2.0 * kDegree;
  look(0.0);
  print("mounting");
  EXPECT_TRUE(estimate_->hand_eye_wrong);
  EXPECT_FALSE(estimate_->time_wrong);
  EXPECT_LT(miss_m(), 0.003);
  EXPECT_LT(miss_rad(), 0.3 * kDegree);
  EXPECT_LT(estimate_->all.after_m, 0.5 * estimate_->all.before_m);
}

TEST_F(HandEyeTest, AClockThatIsOffIsFound) {
  look(-0.11);
  print("clock");
  EXPECT_TRUE(estimate_->time_wrong);
  EXPECT_FALSE(estimate_->hand_eye_wrong);
  EXPECT_NEAR(estimate_->time_offset_s, -0.11, 0.003);
}

TEST_F(HandEyeTest, BothAreToldApart) {
  options_.hand_eye_translation_m = 0.015;
  options_.hand_eye_rotation_rad = 1.5 * kDegree;
  options_.seed = 5;
  look(0.05);
  print("both");
  EXPECT_TRUE(estimate_->hand_eye_wrong);
  EXPECT_TRUE(estimate_->time_wrong);
  EXPECT_NEAR(estimate_->time_offset_s, 0.05, 0.006);
  EXPECT_LT(miss_m(), 0.004);
}

TEST_F(HandEyeTest, FramesThatStandStillTellNoTime) {
  look(0.08, false);
  print("still");
  EXPECT_FALSE(estimate_->time_known);
  EXPECT_FALSE(estimate_->time_wrong);
}

}  // namespace
}  // namespace canopeer::ros
