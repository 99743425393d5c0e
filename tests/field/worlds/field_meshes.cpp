#include "field_meshes.h"

#include <array>
#include <cmath>
#include <cstring>

namespace canopeer::test {
namespace {

constexpr float kHalf = 0.04F;

std::string word(int value) {
  return {static_cast<char>(value & 255), static_cast<char>(value >> 8)};
}

std::string tga_header(int kind, int width, int height, int bits, int descriptor) {
  return std::string(2, '\0') + static_cast<char>(kind) + std::string(9, '\0') + word(width) +
         word(height) + static_cast<char>(bits) + static_cast<char>(descriptor);
}

std::string pixel(Rgb color) {
  return {static_cast<char>(color.b), static_cast<char>(color.g), static_cast<char>(color.r)};
}

constexpr std::array<std::array<int, 3>, 12> kFaces = {{{0, 2, 1},
                                                        {1, 2, 3},
                                                        {4, 5, 6},
                                                        {5, 7, 6},
                                                        {0, 1, 4},
                                                        {1, 5, 4},
                                                        {2, 6, 3},
                                                        {3, 6, 7},
                                                        {0, 4, 2},
                                                        {2, 4, 6},
                                                        {1, 3, 5},
                                                        {3, 7, 5}}};

template <typename T>
void put(T value, std::string* to) {
  to->append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_number(double value, int component, std::string* to) {
  if (component == 5120) {
    put(static_cast<std::int8_t>(std::lround(value)), to);
  } else if (component == 5122) {
    put(static_cast<std::int16_t>(std::lround(value)), to);
  } else {
    put(static_cast<float>(value), to);
  }
}

int bytes_of(int component) { return component == 5126 ? 4 : component == 5122 ? 2 : 1; }
/// Each position takes whole words of four bytes.
int stride_of(int component) { return (3 * bytes_of(component) + 3) / 4 * 4; }

/// What half an edge of the cube is in the file.
double half_in_file(const GltfCube& cube) {
  if (cube.component == 5126) return kHalf;
  if (!cube.normalized) return 40;
  return cube.component == 5122 ? 32767 : 127;
}

/// The node's scale that makes it kHalf.
double node_scale(const GltfCube& cube) {
  if (cube.component == 5126) return 1.0;
  return cube.normalized ? kHalf : kHalf / 40.0;
}

}  // namespace

std::string tga(Rgb color) {
  std::string bytes = tga_header(2, 4, 4, 24, 0);
  for (int i = 0; i < 16; ++i) bytes += pixel(color);
  return bytes;
}

std::string leaf_tga(Rgb color) {
  constexpr int kSize = 32;
  std::string bytes = tga_header(10, kSize, kSize, 32, 0x28);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const double r = std::hypot(row - 0.5 * kSize + 0.5, column - 0.5 * kSize + 0.5);
      bytes += '\x80' + pixel(color) + (r < 0.45 * kSize ? '\xff' : '\0');  // a run of one
    }
  }
  return bytes;
}

std::string cube_obj(const std::string& material, const std::string& mtl_file) {
  std::string text = "mtllib " + mtl_file + "\nusemtl " + material + "\nvt 0.5 0.5\n";
  for (int i = 0; i < 8; ++i) {
    text += "v " + std::to_string((i & 1) != 0 ? kHalf : -kHalf) + " " +
            std::to_string((i & 2) != 0 ? kHalf : -kHalf) + " " +
            std::to_string((i & 4) != 0 ? kHalf : -kHalf) + "\n";
  }
  for (const auto& f : kFaces) {
    text += "f";
    for (const int corner : f) text += " " + std::to_string(corner + 1) + "/1";
    text += "\n";
  }
  return text;
}

std::string gltf_numbers_of(const GltfCube& cube) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) {
      // A corner that is given apart lies at the origin here.
      const bool apart = cube.sparse && i == 7;
      const double side = ((i >> k) & 1) != 0 ? 1.0 : -1.0;
      put_number(apart ? 0.0 : side * half_in_file(cube), cube.component, &bytes);
    }
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  }
  for (const auto& f : kFaces) {
    for (const int corner : f) put(static_cast<std::uint16_t>(corner), &bytes);
  }
  for (const auto& [u, v] : {std::pair{cube.u, cube.v}, std::pair{cube.u1, cube.v1}}) {
    for (int i = 0; i < 8; ++i) {
      put(u, &bytes);
      put(v, &bytes);
    }
  }
  put(std::uint32_t{7}, &bytes);
  for (int k = 0; k < 3; ++k) put(static_cast<float>(half_in_file(cube)), &bytes);
  return bytes;
}

std::string gltf_text(const GltfCube& cube) {
  const int positions = 8 * stride_of(cube.component);
  const auto text = [](double x) { return std::to_string(x); };
  const std::string s = text(node_scale(cube));
  const auto view = [&](int offset, int length, const std::string& more = "") {
    return R"({"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" +
           std::to_string(length) + more + "}";
  };
  const std::string sparse =
      R"(,"sparse":{"count":1,"indices":{"bufferView":4,"componentType":5125},"values":{"bufferView":5}})";
  const std::string material =
      cube.texture.empty()
          ? R"({"name":"fruit"})"
          : R"({"name":"fruit","pbrMetallicRoughness":{"baseColorTexture":)" + cube.texture + "}}";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"name":"cube","mesh":0,"scale":[)" +
         s + "," + s + "," + s +
         R"(]}],"meshes":[{"name":"cube","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":3},"indices":1,"material":0}]}],)"
         R"("materials":[)" +
         material + R"(],"textures":[{"source":0}],"images":[{"uri":"four%20colors.bmp"}],)" +
         R"("accessors":[{"bufferView":0,"componentType":)" + std::to_string(cube.component) +
         R"(,"count":8,"type":"VEC3")" + (cube.normalized ? R"(,"normalized":true)" : "") +
         (cube.sparse ? sparse : "") +
         R"(},{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"},)"
         R"({"bufferView":2,"componentType":5126,"count":8,"type":"VEC2"},)"
         R"({"bufferView":3,"componentType":5126,"count":8,"type":"VEC2"}],)"
         R"("bufferViews":[)" +
         view(0, positions, R"(,"byteStride":)" + std::to_string(stride_of(cube.component))) + "," +
         view(positions, 72) + "," + view(positions + 72, 64) + "," + view(positions + 136, 64) +
         "," + view(positions + 200, 4) + "," + view(positions + 204, 12) +
         R"(],"buffers":[{"byteLength":)" + std::to_string(positions + 216) + R"(,"uri":")" +
         cube.buffer_uri + R"("}])" + cube.extra + "}";
}

Imported import_all_as_fruit(const std::filesystem::path& file,
                             std::vector<std::filesystem::path> model_paths) {
  WorldImportOptions options;
  options.file = file;
  options.model_paths = std::move(model_paths);
  options.patterns.fruit = ".";
  auto world = import_world(options);
  if (!world) return {world.error().message, {}};
  return {"", std::move(*world)};
}

std::string four_colors_bmp() {
  const auto long_word = [](int value) { return word(value & 0xffff) + word(value >> 16); };
  const std::string pixels = pixel({0, 0, 255}) + pixel({255, 255, 255}) + word(0) +
                             pixel({255, 0, 0}) + pixel({0, 255, 0}) + word(0);
  return "BM" + long_word(54 + 16) + long_word(0) + long_word(54) + long_word(40) + long_word(2) +
         long_word(2) + word(1) + word(24) + std::string(24, '\0') + pixels;
}

}  // namespace canopeer::test
