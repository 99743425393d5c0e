#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/robot_mesh.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// How shapes are read.
struct UrdfOptions {
  MeshSearch meshes;
  /// Links without a `<collision>` take their visual shapes for it; those must be readable then.
  bool visual_for_collision = false;
};

/// Reads a robot's links, joints, collision and visual shapes from a URDF file; meshes are looked
/// for as config/robot_mesh.h says, limits and mimic joints as config/urdf_joints.h says.
/// Acceleration limits and disabled pairs are not in a URDF. Errors (malformed XML, xacro that
/// needs expanding, collision meshes that cannot be read, joints without limits, no single tree)
/// name file and line, all that is wrong with links or with joints in one; visual meshes that
/// cannot be read become notices.
[[nodiscard]] Expected<RobotDescription> read_urdf(
    const std::filesystem::path& path, const std::vector<std::filesystem::path>& package_path = {},
    bool visual_for_collision = false);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Expected<RobotDescription> parse_urdf(const std::string& xml, const std::string& name,
                                                    const UrdfOptions& options = {});

}  // namespace canopeer
