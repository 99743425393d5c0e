#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/robot_file.h"

namespace canopeer::test {

/// A file among the inputs of these tests.
inline std::filesystem::path input(const std::string& name) {
  return std::filesystem::path(CANOPEER_SOURCE_DIR "/tests/field/robots/inputs") / name;
}

/// The robot of one of them, which must be readable.
inline RobotModel robot_of(const std::string& name) {
  auto robot = load_robot(input(name));
  if (!robot) throw std::runtime_error(robot.error().message);
  return std::move(*robot);
}

/// All notices of a robot in one text.
inline std::string notices_of(const RobotModel& robot) {
  std::string all;
  for (const std::string& notice : robot.description().notices) all += notice + "\n";
  return all;
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder of the running test's own, removed afterwards.
class OwnFolder {
 public:
  OwnFolder()
      : path_(std::filesystem::temp_directory_path() /
              (std::string("canopeer_field_robots_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~OwnFolder() { std::filesystem::remove_all(path_); }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void put(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    ASSERT_TRUE(write_file(path_ / name, text));
  }

 private:
  std::filesystem::path path_;
};

/// A tetrahedron with edges of `edge` along x, y and z, as OBJ.
inline std::string corner_obj(double edge) {
  const std::string e = std::to_string(edge);
  return "v 0 0 0\nv " + e + " 0 0\nv 0 " + e + " 0\nv 0 0 " + e +
         "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

/// A URDF of one link with these shapes in it, from line 3 on.
inline std::string one_link(const std::string& shapes) {
  return "<robot name='r'>\n<link name='a'>\n" + shapes + "</link></robot>";
}
inline std::string mesh(const std::string& name, const std::string& more = "") {
  return "<collision><geometry><mesh filename='" + name + "' " + more +
         "/></geometry></collision>\n";
}

}  // namespace canopeer::test
