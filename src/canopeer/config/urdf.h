#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/robot_mesh.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Reads a robot's links, joints, collision and visual shapes from a URDF file; meshes are looked
/// for as config/robot_mesh.h says, limits and mimic joints as config/urdf_joints.h says.
/// Acceleration limits and disabled pairs are not in a URDF. Errors (malformed XML, xacro that
/// needs expanding, a collision mesh that cannot be read, joints without limits, no single tree)
/// name file and line; a visual mesh that cannot be read becomes a notice.
[[nodiscard]] Expected<RobotDescription> read_urdf(
    const std::filesystem::path& path, const std::vector<std::filesystem::path>& package_path = {});

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Expected<RobotDescription> parse_urdf(const std::string& xml, const std::string& name,
                                                    const MeshSearch& search = {});

}  // namespace canopeer
