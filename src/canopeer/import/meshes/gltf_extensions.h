#pragma once

#include <nlohmann/json_fwd.hpp>

namespace canopeer {

/// Throws std::runtime_error over an extension that a glTF file needs and that is not read.
void check_needed_extensions(const nlohmann::json& file);

/// Throws std::runtime_error when the numbers of a primitive are there in packed form only.
void check_packing(const nlohmann::json& file, const nlohmann::json& primitive);

}  // namespace canopeer
