#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/import/meshes/collada_asset.h"
#include "canopeer/scene/scene.h"

namespace canopeer::test {

/// A surface with a material, in metres and z up: what a file is to mean.
struct Painted {
  std::string material;
  TriangleMesh mesh;
  Rgb color{200, 40, 10};
  std::string
      texture;  ///< file name; empty: none. Texture coordinates are x and y of the vertices.
};

/// How a COLLADA file says it.
struct DaeStyle {
  double unit_m = 1.0;
  std::string unit_name = "meter";
  UpAxis up = UpAxis::z;
  Eigen::Affine3d node = Eigen::Affine3d::Identity();   ///< matrix of the inner node
  Eigen::Affine3d outer = Eigen::Affine3d::Identity();  ///< matrix of the node around it
};

/// The COLLADA text that means `surfaces`: one mesh of several materials, with coordinates such
/// that unit, axis and node matrices take them where they should be.
std::string dae(const std::vector<Painted>& surfaces, const DaeStyle& style = {});

std::string obj(const std::vector<Painted>& surfaces, const std::string& mtl_file);
std::string mtl(const std::vector<Painted>& surfaces);
std::string binary_stl(const TriangleMesh& mesh);
/// ASCII, with vertex colours.
std::string colored_ply(const std::vector<Painted>& surfaces);

std::string ascii_stl(const TriangleMesh& mesh);
/// Little-endian, with vertex colours.
std::string binary_colored_ply(const std::vector<Painted>& surfaces);
/// glTF as text: one mesh, one primitive for each surface, its numbers in the file `bin_file`; z up
/// becomes y up, as the format has it.
std::string gltf(const std::vector<Painted>& surfaces, const std::string& bin_file);
std::string gltf_bin(const std::vector<Painted>& surfaces);

/// A ball of 16 × 8 facets; its box is exactly `centre` ± `radius`.
TriangleMesh ball(const Vec3& centre, double radius);
/// A rectangle in the x–y plane.
TriangleMesh sheet(const Vec3& low, const Vec3& high);

/// Volume of `mesh`, cm³: of the balls here, which are convex.
double volume_cm3(const TriangleMesh& mesh);

}  // namespace canopeer::test
