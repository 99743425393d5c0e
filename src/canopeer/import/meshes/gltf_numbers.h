#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace canopeer {

/// The numbers behind an accessor of glTF, `width` each (VEC3: 3), as floats: whole numbers are
/// shares of their range when the accessor is normalized. Sparse ones are filled in. Throws over
/// numbers that are not there, and over another width.
[[nodiscard]] std::vector<float> gltf_numbers(const nlohmann::json& file,
                                              const std::vector<std::string>& buffers,
                                              std::size_t accessor, std::size_t width);

}  // namespace canopeer
