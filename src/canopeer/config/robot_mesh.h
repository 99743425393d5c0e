#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Where a robot's mesh files are looked for.
struct MeshSearch {
  std::filesystem::path directory;                  ///< of the URDF: relative names start here
  std::vector<std::filesystem::path> package_path;  ///< folders that hold packages, or are one
};

/// The file a URDF's mesh name means. `package://NAME/REST` is looked for as NAME/REST in each
/// folder of the package path and in each folder above the URDF, and as REST in those of them that
/// are called NAME; `file://` and plain names are paths. The error lists where it was looked for.
[[nodiscard]] Expected<std::filesystem::path> find_mesh(const std::string& name,
                                                        const MeshSearch& search);

/// Reads all triangles of a mesh (STL, DAE, OBJ and what else import/mesh_file.h knows), scaled,
/// placed in its link. COLLADA's unit is followed, its up axis is not, as in RViz and Gazebo.
[[nodiscard]] Expected<CollisionShape> load_mesh_shape(const std::string& name, const Vec3& scale,
                                                       const Pose& T_link_mesh,
                                                       const MeshSearch& search);

}  // namespace canopeer
