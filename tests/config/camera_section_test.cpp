#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/mission_file.h"
#include "canopeer/config/robot_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Reads a small mission with these lines more.
Expected<MissionFile> mission_with(const std::string& lines) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path path =
      fs::temp_directory_path() / (std::string("canopeer_camera_") + test->name() + ".yaml");
  EXPECT_TRUE(
      write_file(path, "robot: robot.yaml\nstops_travel_m: [0]\ncompute_table: free\n" + lines));
  auto mission = load_mission(path, {}, {});
  fs::remove(path);
  return mission;
}

std::string complaint_about(const std::string& lines) {
  const auto mission = mission_with(lines);
  return mission ? "accepted" : mission.error().message;
}

TEST(CameraSection, PresetsAreThePapersCameraAndTwoRealOnes) {
  const auto paper = mission_with("");
  ASSERT_TRUE(paper) << paper.error().message;
  EXPECT_NEAR(paper->simulation.camera.fx, 381.36, 0.01);
  EXPECT_FALSE(paper->simulation.sensor.noise.any_depth());
  EXPECT_FALSE(paper->T_frame_camera);
  const auto d405 = mission_with("camera: {preset: d405, max_range_m: 0.8}\nnoise: d405\n");
  ASSERT_TRUE(d405) << d405.error().message;
  EXPECT_EQ(d405->simulation.camera.min_range_m, 0.07);
  EXPECT_EQ(d405->simulation.camera.max_range_m, 0.8);
  EXPECT_EQ(d405->simulation.sensor.noise.baseline_m, 0.018);
}

TEST(CameraSection, EveryFaultCanBeSetAlone) {
  const auto mission = mission_with(
      "noise: d435\nnoise_model: {lateral_px: 0, baseline_m: 0.06}\nlabel_noise: 0.3\n"
      "camera:\n  fx_px: 400\n  cx_px: 310.5\n  distortion: [-0.1, 0.02, 0, 0.001, 0]\n"
      "  hand_eye_error_m: 0.002\n  mounting: {xyz_m: [0, 0.05, 0.1], rpy_deg: [0, 0, 90]}\n");
  ASSERT_TRUE(mission) << mission.error().message;
  const SimulationOptions& o = mission->simulation;
  EXPECT_EQ(o.camera.fx, 400.0);
  EXPECT_EQ(o.camera.cx, 311.0);
  EXPECT_EQ(o.sensor.lens.p2, 0.001);
  EXPECT_EQ(o.sensor.noise.lateral_px, 0.0);
  EXPECT_EQ(o.sensor.noise.baseline_m, 0.06);
  EXPECT_EQ(o.sensor.noise.disparity_noise_px, 0.08);
  EXPECT_EQ(o.sensor.label_noise, 0.3);
  EXPECT_EQ(o.sensor.hand_eye_translation_m, 0.002);
  ASSERT_TRUE(mission->T_frame_camera);
  EXPECT_NEAR((*mission->T_frame_camera * Vec3::UnitX() - Vec3(0, 1.05, 0.1)).norm(), 0.0, 1e-12);
}

TEST(CameraSection, MotionIsOffAndSetByAPresetOrFigureByFigure) {
  const auto motion = [](const std::string& lines) {
    const auto mission = mission_with(lines);
    EXPECT_TRUE(mission) << lines << mission.error().message;
    return mission ? mission->simulation.sensor.motion : CameraMotionOptions{};
  };
  EXPECT_FALSE(motion("").any());
  EXPECT_FALSE(motion("camera: {preset: d435}\n").any());
  EXPECT_EQ(motion("camera: {motion: d435}\n").exposure_s, 0.0085);
  const CameraMotionOptions o = motion(
      "camera:\n  motion: d435\n  motion_model: {exposure_ms: 5, stamp_offset_ms: -30, "
      "depth_rolls: true, sub_frames: 7}\n");
  EXPECT_EQ(o.exposure_s, 0.005);
  EXPECT_EQ(o.readout_s, 0.016);
  EXPECT_EQ(o.stamp_offset_s, -0.03);
  EXPECT_TRUE(o.depth_rolls);
  EXPECT_EQ(o.sub_frames, 7);
  const CameraMotionOptions single =
      motion("camera: {motion_model: {readout_ms: 10, latency_ms: 40, stamp_jitter_ms: 1.5}}\n");
  EXPECT_EQ(single.exposure_s, 0.0);
  EXPECT_EQ(single.readout_s, 0.01);
  EXPECT_EQ(single.latency_s, 0.04);
  EXPECT_EQ(single.stamp_jitter_s, 0.0015);
}

TEST(CameraSection, RefusesMotionThatCannotBe) {
  const auto said = [](const std::string& model, const std::string& word) {
    return complaint_about("camera: {motion_model: {" + model + "}}\n").find(word) !=
           std::string::npos;
  };
  EXPECT_NE(complaint_about("camera: {motion: d415}\n").find("global_shutter"), std::string::npos);
  EXPECT_TRUE(said("exposure_ms: -1", "exposure_ms"));
  EXPECT_TRUE(said("readout_ms: 1001", "readout_ms"));
  EXPECT_TRUE(said("latency_ms: long", "latency_ms"));
  EXPECT_TRUE(said("stamp_offset_ms: -2000", "stamp_offset_ms"));
  EXPECT_TRUE(said("sub_frames: 0", "sub_frames"));
  EXPECT_TRUE(said("exposure_s: 0.01", "exposure_ms"));
}

TEST(CameraSection, RefusesWhatCannotBe) {
  EXPECT_NE(complaint_about("noise: d453\n").find("d435"), std::string::npos);
  EXPECT_NE(complaint_about("label_noise: 0.7\n").find("label_noise"), std::string::npos);
  EXPECT_NE(complaint_about("noise_model: {disparity_noise_px: 0.1}\n").find("baseline_m"),
            std::string::npos);
  EXPECT_NE(complaint_about("camera: {distortion: [-2, 0, 0, 0, 0]}\n").find("folds back"),
            std::string::npos);
  EXPECT_NE(complaint_about("camera: {distortion: [0.1]}\n").find("distortion"), std::string::npos);
  EXPECT_NE(complaint_about("noise_model: {lateral: 1}\n").find("lateral_px"), std::string::npos);
}

TEST(CameraSection, TheMountingMovesTheCameraAndNothingElse) {
  const fs::path path = CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml";
  const auto plain = load_robot(path);
  Pose mounting = Pose::Identity();
  mounting.translation() = Vec3(0.0, -0.04, 0.03);
  mounting.linear() = Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
  const auto moved = load_robot(path, mounting);
  ASSERT_TRUE(plain && moved);
  const Configuration& q = plain->home("side_1");
  EXPECT_TRUE(moved->T_base_camera(q).isApprox(plain->T_base_camera(q) * mounting, 1e-12));
  EXPECT_EQ(moved->dof(), plain->dof());
}

}  // namespace
}  // namespace canopeer
