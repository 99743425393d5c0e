#pragma once

#include <string>
#include <vector>

#include "canopeer/import/world_import.h"
#include "canopeer/sensing/image.h"
#include "world_files.h"

namespace canopeer::test {

/// A picture file of one colour, 4 × 4 pixels, uncompressed TGA, 24 bits.
std::string tga(Rgb color);
/// The same with opacity: a disc of colour with nothing around it, 32 × 32 pixels, in runs, 32
/// bits.
std::string leaf_tga(Rgb color);

/// An OBJ cube of 8 cm about the origin, all of whose texture coordinates are the picture's middle.
std::string cube_obj(const std::string& material, const std::string& mtl_file);

/// A cube of 8 cm about the origin as glTF, in the words that a test asks for.
struct GltfCube {
  int component = 5126;     ///< of positions: 5126 floats, 5122 whole numbers of 16 bits, 5120 of 8
  bool normalized = false;  ///< whole numbers are shares; a node scales them back
  bool sparse = false;      ///< one corner is given apart
  std::string buffer_uri = "cube.bin";
  std::string extra;             ///< members of the root, each with a comma before it
  std::string texture;           ///< JSON of the base colour's texture info; empty: none
  float u = 0.25F, v = 0.25F;    ///< of all corners, first set
  float u1 = 0.75F, v1 = 0.75F;  ///< second set
};
/// The text, and the numbers beside it.
std::string gltf_text(const GltfCube& cube);
std::string gltf_numbers_of(const GltfCube& cube);

/// What an import says, for expectations on its message or its fruits.
struct Imported {
  std::string error;  ///< empty: none
  ImportedScene world;
};
Imported import_all_as_fruit(const std::filesystem::path& file,
                             std::vector<std::filesystem::path> model_paths = {});

/// A 2 × 2 picture file (BMP): red, green over blue, white.
std::string four_colors_bmp();

}  // namespace canopeer::test
