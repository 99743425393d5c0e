#pragma once

#include <filesystem>

#include "canopeer/geometry/pose.h"
#include "canopeer/import/meshes/file_material_reader.h"
#include "canopeer/import/meshes/file_mesh.h"

namespace canopeer {

/// From the root node of a mesh file to metres with z up.
struct RootFrame {
  Eigen::Affine3d T_upright_root = Eigen::Affine3d::Identity();
  /// Assimp multiplies the unit from the right, where a translation of the root does not feel it.
  /// So it is taken off there and put on from the left.
  double unit_m = 1.0;
};

/// Reads a mesh with assimp: triangles, materials, embedded pictures. Throws std::exception over
/// what the library refuses. Over some damaged files the library ends the process or hangs: run
/// this inside a guarded_call().
[[nodiscard]] FileMesh read_with_library(const std::filesystem::path& path, const RootFrame& frame,
                                         MaterialDialect dialect);

}  // namespace canopeer
