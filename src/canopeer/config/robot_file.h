#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// Reads a robot.yaml and the URDF and SRDF it names (relative to it). Errors name file, line and
/// key, what was expected, and the nearest valid key.
/// What its files lack but can be done without is in its description's notices, such as links
/// that nothing is checked for.
/// Where the camera is mounted on the URDF's camera frame (hand–eye transformation) comes from
/// `T_frame_camera`, else from the file's `camera_mounting`, else it is that frame.
/// `package_path`: where packages of meshes are looked for besides the file's own `package_path`.
[[nodiscard]] Expected<RobotModel> load_robot(
    const std::filesystem::path& path, const std::optional<Pose>& T_frame_camera = {},
    const std::vector<std::filesystem::path>& package_path = {});

/// Where load_robot() mounted the camera of this robot on the URDF's camera frame.
[[nodiscard]] Pose camera_mounting(const RobotModel& robot);

/// The URDF that a robot.yaml names. Errors as above.
[[nodiscard]] Expected<std::filesystem::path> robot_urdf(const std::filesystem::path& path);

/// `xyz_m` and `rpy_deg` (fixed axes x, y, z), both zero by default.
[[nodiscard]] Pose read_pose(YamlMap pose);

}  // namespace canopeer
