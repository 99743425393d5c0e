#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/meshes/mesh_piece.h"
#include "canopeer/import/sdf/model_paths.h"

namespace canopeer {

/// What an SDF material says beside its mesh.
struct SdfMaterial {
  std::optional<Rgb> color;
  std::string name;                              ///< of its script, e.g. "Gazebo/Red"
  std::optional<std::filesystem::path> texture;  ///< albedo map
};

/// A visual of an SDF world in its place: a mesh file, or a primitive.
struct SdfVisual {
  Eigen::Affine3d T_world_visual = Eigen::Affine3d::Identity();  ///< scales included
  std::filesystem::path mesh;                                    ///< empty: `primitive`
  std::string submesh;  ///< only the part of the mesh with this name; empty: all
  bool center_submesh = false;
  TriangleMesh primitive;
  SdfMaterial material;
  bool see_through = false;
  PartNames names;    ///< visual, link, model
  std::string where;  ///< "file:line", of the geometry
};

struct SdfWorld {
  std::string name;
  std::vector<SdfVisual> visuals;
  std::vector<std::string> notices;
};

/// Reads an SDF 1.4 … 1.12 world, or a lone model, with all it includes. Poses, frames and nested
/// models resolve as SDF says; the poses and scales of a <state> block come before those of the
/// models, as in Gazebo. `model://sun` and `model://ground_plane` need not be there. Error: which
/// file, which line and element, what was expected.
[[nodiscard]] Expected<SdfWorld> read_sdf_world(const std::filesystem::path& path,
                                                const ModelPaths& paths);

/// The same of the text of a file at `path`.
[[nodiscard]] Expected<SdfWorld> parse_sdf_world(std::string_view text,
                                                 const std::filesystem::path& path,
                                                 const ModelPaths& paths);

}  // namespace canopeer
