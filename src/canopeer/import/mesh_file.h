#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/meshes/mesh_piece.h"
#include "canopeer/import/meshes/texture_file.h"

namespace canopeer {

/// A mesh file in metres with z up.
struct MeshFile {
  std::vector<MeshPiece> pieces;
  /// The child of the file's root that each piece hangs on; the file's name without ending when
  /// there is no such child.
  std::vector<std::string> groups;
  std::vector<std::string> notices;  ///< what is missing but can be done without
};

/// How a mesh is read, and what reading it may cost.
struct MeshFileOptions {
  /// COLLADA's `<up_axis>`: true turns the mesh upright as COLLADA asks; false takes coordinates as
  /// they are, as Gazebo does.
  bool honour_up_axis = true;
  /// Processor time that even the smallest file may take, > 0; larger ones get more.
  double least_cpu_s = 20.0;
  /// Memory that even the smallest file may take while it is parsed; larger ones get more.
  std::size_t least_memory_bytes = 4UL << 30U;
};

/// Whether read_mesh_file() knows the ending: .dae, .obj, .stl, .gltf, .glb, .ply.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);

/// Reads a mesh with its materials, textures and vertex colours. COLLADA: unit, up axis and node
/// matrices are followed, whatever assimp makes of them; glTF is y up and becomes z up; OBJ, STL
/// and PLY say nothing and are taken as they are. Textures that are missing become notices. The
/// file is parsed in a child process (guarded_call.h), with a limit on time and memory. Error: a
/// file that is not there, of no known kind, or broken; the message names it.
[[nodiscard]] Expected<MeshFile> read_mesh_file(const std::filesystem::path& path,
                                                const MeshFileOptions& options,
                                                TextureStore& textures);

}  // namespace canopeer
