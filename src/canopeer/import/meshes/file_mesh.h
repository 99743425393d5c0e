#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/meshes/mesh_piece.h"

namespace canopeer {

/// A material as a mesh file states it, its pictures not read yet.
struct FileMaterial {
  std::string name;
  Rgb color{180, 180, 180};
  std::string picture;  ///< as the file refers to it; empty: none
  std::string mask;     ///< a picture of its own for the opacity; empty: none
  bool alpha_cuts = true;
  std::uint8_t cut_below = 128;  ///< opacity, 0 … 255
  bool see_through = false;
  bool tints = false;  ///< `color` multiplies the picture, as shares of light: glTF
};

/// What a mesh library makes of a file, in metres with z up.
struct FileMesh {
  struct Part {
    MeshPiece piece;  ///< no texture yet
    std::uint32_t material = 0;
    std::string group;  ///< the child of the file's root it hangs on; empty: the root itself
  };
  std::vector<Part> parts;
  std::vector<FileMaterial> materials;
  std::map<std::string, std::string> pictures;  ///< inside the file: reference → a picture file
  std::vector<std::string> notices;
};

/// As bytes, for passing it from one process to another on the same machine.
[[nodiscard]] std::string encode(const FileMesh& mesh);

/// Takes any bytes: lengths and indices are checked before they are used. Error: what is wrong.
[[nodiscard]] Expected<FileMesh> decode_file_mesh(std::string_view bytes);

}  // namespace canopeer
