#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "canopeer/config/mission_file.h"

// The settings and launch files of the ament package (ros2/) say keys that the program knows.

namespace canopeer {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = CANOPEER_SOURCE_DIR;

Expected<MissionFile> one_stop_with(const Overrides& more) {
  Overrides overrides = {{"robot", (kRoot / "robots/ur5e_trolley/robot.yaml").string()}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return load_mission(kRoot / "ros2/missions/one_stop.yaml", overrides, {kRoot / "compute_tables"});
}

TEST(AmentPackage, SettingsOfEveryRobotAreUnderstood) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "ros2/settings")) {
    const auto mission = one_stop_with({{"ros2", entry.path().string()}});
    ASSERT_TRUE(mission.has_value()) << entry.path() << ": " << mission.error().message;
    ASSERT_TRUE(mission->ros2.has_value()) << entry.path();
    EXPECT_EQ(mission->ros2->arm.action.rfind('/', 0), 0U) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3);
}

TEST(AmentPackage, LaunchArgumentsSetKeysThatExist) {
  std::ifstream file(kRoot / "ros2/launch/canopeer.launch.py");
  std::stringstream text;
  text << file.rdbuf();
  const std::string launch = text.str();
  static const std::regex kKey("\\('(ros2\\.[a-z0-9_.]+)',");
  int keys = 0;
  for (std::sregex_iterator it(launch.begin(), launch.end(), kKey), end; it != end; ++it, ++keys) {
    // The value may be wrong, the key must be known.
    const auto mission = one_stop_with({{(*it)[1], "true"}});
    const std::string said = mission.has_value() ? "" : mission.error().message;
    EXPECT_EQ(said.find("unknown key"), std::string::npos) << said;
  }
  EXPECT_GT(keys, 10);
}

}  // namespace
}  // namespace canopeer
