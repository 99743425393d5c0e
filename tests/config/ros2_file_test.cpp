#include "canopeer/config/ros2_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/mission_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, with a mission in it.
class Ros2File : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("canopeer_ros2_file_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file(folder_ / name, text));
  }
  Expected<MissionFile> mission(const std::string& lines, const Overrides& overrides = {}) {
    write("mission.yaml", "robot: robot.yaml\nstops_travel_m: [0]\ncompute_table: free\n" + lines);
    return load_mission(folder_ / "mission.yaml", overrides, {});
  }
  std::string error_of(const std::string& lines, const Overrides& overrides = {}) {
    const auto file = mission(lines, overrides);
    return file ? "no error" : file.error().message;
  }

  fs::path folder_;
};

TEST_F(Ros2File, LeavesNoTraceInMissionsThatDoNotNameIt) {
  const auto file = mission("");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_FALSE(file->ros2);
  EXPECT_EQ(file->settings_json.find("ros2"), std::string::npos);
}

TEST_F(Ros2File, ReadsAMappingInTheMission) {
  const auto file = mission(
      "ros2:\n"
      "  namespace: /left\n"
      "  domain: 7\n"
      "  interfaces: 10.0.0.2\n"
      "  remaps: {/joint_states: /left/joints}\n"
      "  arm: {joint_states: [/a, /b], joint_names: {elbow: ur_elbow}, speed_scale: 0.3}\n"
      "  camera: {pose: tf, reliable: true}\n"
      "  trolley: {kind: topics, travel_command: /travel, start_m: [1.5, 0.2]}\n");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_TRUE(file->ros2);
  const Ros2Settings& o = *file->ros2;
  EXPECT_EQ(o.ns, "/left");
  EXPECT_EQ(o.domain, 7);
  EXPECT_EQ(o.interfaces, std::vector<std::string>{"10.0.0.2"});
  EXPECT_EQ(o.remaps.at("/joint_states"), "/left/joints");
  EXPECT_EQ(o.arm.joint_states, (std::vector<std::string>{"/a", "/b"}));
  EXPECT_EQ(o.arm.joint_names.at("elbow"), "ur_elbow");
  EXPECT_EQ(o.arm.speed_scale, 0.3);
  EXPECT_EQ(o.arm.rate_hz, Ros2ArmSettings().rate_hz);
  EXPECT_EQ(o.camera.pose, "tf");
  EXPECT_TRUE(o.camera.reliable);
  EXPECT_EQ(o.trolley.kind, Ros2TrolleySettings::Kind::topics);
  EXPECT_EQ(o.trolley.start_m, (std::vector<double>{1.5, 0.2}));
  EXPECT_NE(file->settings_json.find("\"ros2.arm.speed_scale\": 0.3"), std::string::npos);
  EXPECT_NE(file->settings_json.find("\"ros2.arm.rate_hz\": 100"), std::string::npos);
}

TEST_F(Ros2File, ReadsAFileThatTheMissionNames) {
  write("ur.yaml", "arm:\n  action: /ur/follow\ntrolley: {kind: fixed}\n");
  const auto file = mission("ros2: ur.yaml\n", {{"ros2.arm.speed_scale", "0.2"}});
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->ros2->arm.action, "/ur/follow");
  EXPECT_EQ(file->ros2->arm.speed_scale, 0.2);
  EXPECT_EQ(file->ros2->trolley.kind, Ros2TrolleySettings::Kind::fixed);
  EXPECT_NE(file->settings_json.find("\"ros2\": \"ur.yaml\""), std::string::npos);
  EXPECT_NE(file->settings_json.find("\"ros2.arm.speed_scale\": 0.2"), std::string::npos);
  EXPECT_EQ(file->settings_json.find("}, "), std::string::npos);
}

TEST_F(Ros2File, IsNamedOrMadeByTheCommandLineToo) {
  write("ur.yaml", "domain: 3\n");
  const auto named = mission("", {{"ros2.dry_run", "true"}, {"ros2", "ur.yaml"}});
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_EQ(named->ros2->domain, 3);
  EXPECT_TRUE(named->ros2->dry_run);
  const auto made = mission("", {{"ros2.remaps./joint_states", "/arm/joint_states"}});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->ros2->remaps.at("/joint_states"), "/arm/joint_states");
  EXPECT_FALSE(made->ros2->domain);
}

TEST_F(Ros2File, SaysFileLineAndNearestKey) {
  EXPECT_NE(error_of("ros2:\n  arm:\n    speed_scal: 0.5\n")
                .find("mission.yaml:6: unknown key 'speed_scal'; did you mean 'speed_scale'?"),
            std::string::npos);
  EXPECT_NE(error_of("ross2: {}\n").find("did you mean 'ros2'?"), std::string::npos);
  write("ur.yaml", "arm:\n  speed_scale: 1.5\n");
  EXPECT_NE(error_of("ros2: ur.yaml\n")
                .find("ur.yaml:2: speed_scale: expected a number between 0.01 and 1, found '1.5'"),
            std::string::npos);
  EXPECT_NE(error_of("ros2: none.yaml\n").find("mission.yaml:4: ros2: "), std::string::npos);
}

TEST_F(Ros2File, SaysWhatDoesNotGoTogether) {
  EXPECT_NE(error_of("ros2:\n  trolley:\n    kind: trajectory\n")
                .find("mission.yaml:5: trolley: action: is missing, which 'trajectory' needs"),
            std::string::npos);
  EXPECT_NE(error_of("ros2:\n  camera: {confidences: /c}\n").find("5: camera: labels: is missing"),
            std::string::npos);
  EXPECT_NE(error_of("ros2:\n  trolley: {start_m: [1]}\n").find("expected [travel, lift]"),
            std::string::npos);
}

TEST(Ros2Settings, AreGoodByDefault) { EXPECT_TRUE(Ros2Settings().validate()); }

TEST(Ros2Settings, OfNumbersThatAreNoneAreRefused) {
  Ros2Settings settings;
  settings.arm.speed_scale = std::nan("");
  const auto checked = settings.validate();
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("ros2.arm.speed_scale"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
