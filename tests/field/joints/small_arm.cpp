#include "small_arm.h"

#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/robot_file.h"

namespace canopeer::test {
namespace {

constexpr const char* kLimit = "<limit lower='-2.5' upper='2.5' velocity='1.5' effort='9'/>";

std::filesystem::path folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::temp_directory_path() /
         (std::string("canopeer_") + test->test_suite_name() + "_" + test->name());
}

std::string without_folder(std::string text) {
  const std::string name = folder().string() + "/";
  for (auto at = text.find(name); at != std::string::npos; at = text.find(name))
    text.erase(at, name.size());
  return text;
}

}  // namespace

std::string joint_line(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& xyz, const std::string& axis,
                       const std::string& more) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='" + xyz + "'/><axis xyz='" + axis + "'/>" +
         more + "</joint>\n";
}

SmallArm::SmallArm() {
  const auto link = [](const std::string& name, const std::string& size, const std::string& at) {
    return "<link name='" + name + "'><collision><origin xyz='" + at + "'/><geometry><box size='" +
           size + "'/></geometry></collision></link>\n";
  };
  urdf = "<robot name='small'>\n<link name='base'/>\n" + link("waist", "0.06 0.06 0.06", "0 0 0") +
         link("upper", "0.04 0.04 0.3", "0 0 0.2") + link("fore", "0.25 0.04 0.04", "0.17 0 0") +
         link("roll", "0.03 0.03 0.03", "0 0 0") + link("bend", "0.03 0.03 0.03", "0 0 0") +
         link("tool", "0.03 0.03 0.03", "0.02 0 0") + "<link name='camera'/>\n" +
         joint_line("j1", "revolute", "base", "waist", "0 0 0.2", "0 0 1", kLimit) +
         joint_line("j2", "revolute", "waist", "upper", "0 0 0.1", "0 1 0", kLimit) +
         joint_line("j3", "revolute", "upper", "fore", "0 0 0.4", "0 1 0", kLimit) +
         joint_line("j4", "revolute", "fore", "roll", "0.35 0 0", "1 0 0", kLimit) +
         joint_line("j5", "revolute", "roll", "bend", "0.08 0 0", "0 1 0", kLimit) +
         joint_line("j6", "revolute", "bend", "tool", "0.08 0 0", "1 0 0", kLimit) +
         "<joint name='mount' type='fixed'><parent link='tool'/><child link='camera'/><origin "
         "xyz='0.06 0 0' rpy='-1.5707963267948966 0 -1.5707963267948966'/></joint>\n</robot>\n";
  yaml =
      "urdf: small.urdf\nbase_link: base\ncamera_frame: camera\n"
      "arm_joints: [j1, j2, j3, j4, j5, j6]\n"
      "home_states_rad: {side_1: [1.5, -0.6, 1.2, 0.0, 0.3, 0.0]}\n"
      "sides:\n  - {workspace: {x_m: [-0.4, 0.4], y_m: [0.2, 0.6], z_m: [0.3, 1.0]}, "
      "sampling_region: {x_m: [-0.5, 0.5], y_m: [0.5, 1.1], z_m: [0.1, 1.1]}}\n";
}

SmallArm& SmallArm::replace(const std::string& from, const std::string& to) {
  for (std::string* text : {&urdf, &yaml}) {
    const auto at = text->find(from);
    if (at == std::string::npos) continue;
    text->replace(at, from.size(), to);
    return *this;
  }
  ADD_FAILURE() << "not in either file: " << from;
  return *this;
}

SmallArm& SmallArm::add(const std::string& urdf_lines, const std::string& yaml_lines) {
  urdf.insert(urdf.find("</robot>"), urdf_lines);
  yaml += yaml_lines;
  return *this;
}

Expected<RobotModel> SmallArm::load() const {
  const auto directory = folder();
  std::filesystem::create_directories(directory);
  EXPECT_TRUE(write_file(directory / "small.urdf", urdf));
  EXPECT_TRUE(write_file(directory / "robot.yaml", yaml));
  auto robot = load_robot(directory / "robot.yaml");
  std::filesystem::remove_all(directory);
  return robot;
}

RobotModel SmallArm::model() const {
  auto robot = load();
  EXPECT_TRUE(robot.has_value()) << robot.error().message;
  return *robot;
}

std::string SmallArm::error() const {
  const auto robot = load();
  return robot ? "accepted" : without_folder(robot.error().message);
}

std::string SmallArm::notices() const {
  const auto robot = load();
  EXPECT_TRUE(robot.has_value()) << robot.error().message;
  std::string all;
  for (const std::string& notice : robot->description().notices)
    all += (all.empty() ? "" : "\n") + without_folder(notice);
  return all;
}

Pose pose_of(const RobotModel& robot, const std::string& link, const Configuration& q) {
  std::vector<Pose> all;
  robot.link_poses(q, {}, all);
  return all.at(static_cast<std::size_t>(robot.link_index(link)));
}

}  // namespace canopeer::test
