#include "canopeer/import/meshes/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace canopeer {
namespace {

using nlohmann::json;

/// What a file may need and gets here: what is read, and what changes no surface and no base
/// colour.
constexpr std::array<std::string_view, 11> kKnown = {
    "KHR_mesh_quantization", "KHR_texture_transform", "KHR_texture_basisu",  "EXT_texture_webp",
    "EXT_texture_avif",      "MSFT_texture_dds",      "KHR_lights_punctual", "KHR_xmp_json_ld",
    "KHR_animation_pointer", "KHR_technique_webgl",   "KHR_techniques_webgl"};

struct Packing {
  std::string_view extension;
  std::string_view advice;
};
constexpr std::array kPackings = {
    Packing{"KHR_draco_mesh_compression",
            "packs its meshes with Draco; export it without compression, or unpack it: "
            "gltf-transform copy in.glb out.glb"},
    Packing{"EXT_meshopt_compression",
            "packs its numbers with meshoptimizer; export it without compression, or unpack it: "
            "gltf-transform copy in.glb out.glb"}};

}  // namespace

void check_needed_extensions(const json& file) {
  for (const json& entry : file.value("extensionsRequired", json::array())) {
    const std::string name = entry.get<std::string>();
    const bool known = name.starts_with("KHR_materials_") ||
                       std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
    if (known) continue;
    for (const Packing& packing : kPackings) {
      if (name == packing.extension) {
        throw std::runtime_error("the glTF extension '" + name + "' " +
                                 std::string(packing.advice));
      }
    }
    throw std::runtime_error("it needs the glTF extension '" + name +
                             "', which is not read; export it without");
  }
}

void check_packing(const json& file, const json& primitive) {
  const json extensions = primitive.value("extensions", json::object());
  const json& attributes = primitive.at("attributes");
  for (const Packing& packing : kPackings) {
    if (!extensions.contains(packing.extension) || !attributes.contains("POSITION")) continue;
    const json& positions = file.at("accessors").at(attributes.at("POSITION").get<std::size_t>());
    if (positions.contains("bufferView")) continue;  // it is there unpacked, too
    throw std::runtime_error("the glTF extension '" + std::string(packing.extension) + "' " +
                             std::string(packing.advice));
  }
}

}  // namespace canopeer
