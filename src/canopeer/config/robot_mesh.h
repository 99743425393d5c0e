#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/package_search.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Where a robot's mesh files are looked for.
struct MeshSearch {
  std::filesystem::path directory;                  ///< of the URDF: relative names start here
  std::vector<std::filesystem::path> package_path;  ///< folders that hold packages, or are one
};

/// Why a mesh's name leads to no shape.
struct MeshTrouble {
  std::string what;  ///< to follow the name: "not found; looked in …"; the same for all meshes of
                     ///< a package that is not there
  std::string near;  ///< a file that may be meant; empty: none
};

/// Finds and reads the meshes of one robot, each file once.
class RobotMeshReader {
 public:
  explicit RobotMeshReader(const MeshSearch& search);

  /// The file a URDF's mesh name means. `package://NAME/REST` and `model://NAME/REST` are files of
  /// a package (config/package_search.h); `file://` and plain names are paths, relative ones beside
  /// the URDF. %20 means a blank and \ means / where there is no file of the name as it stands.
  [[nodiscard]] tl::expected<std::filesystem::path, MeshTrouble> find(const std::string& name);

  /// All triangles of a mesh (STL, DAE, OBJ and what else import/mesh_file.h knows), scaled, placed
  /// in its link. COLLADA's unit is followed, its up axis is not, as in RViz and Gazebo. A scale
  /// below 0 mirrors; what was outside stays outside.
  [[nodiscard]] tl::expected<CollisionShape, MeshTrouble> load(const std::string& name,
                                                               const Vec3& scale,
                                                               const Pose& T_link_mesh);

 private:
  [[nodiscard]] std::string near(const std::vector<std::filesystem::path>& wanted) const;

  std::filesystem::path directory_;
  PackageSearch packages_;
  // By file and scale, in the mesh's own frame.
  std::map<std::pair<std::string, std::vector<double>>, CollisionShape> read_;
};

}  // namespace canopeer
