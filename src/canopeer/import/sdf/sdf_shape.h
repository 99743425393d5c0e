#pragma once

#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/import/sdf/model_paths.h"
#include "canopeer/import/sdf/sdf_world.h"

namespace sdf {
inline namespace v12 {
class Visual;
}
}  // namespace sdf

namespace canopeer {

/// Fills in geometry and material of `visual`. False: a kind of shape that cannot be shown; a
/// notice has been added. `default_folder`: of the world, when SDF does not know the file. Error: a
/// mesh that is not there.
[[nodiscard]] Expected<bool> read_sdf_shape(const sdf::Visual& from, const ModelPaths& paths,
                                            const std::filesystem::path& default_file,
                                            SdfVisual* visual, std::vector<std::string>* notices);

}  // namespace canopeer
