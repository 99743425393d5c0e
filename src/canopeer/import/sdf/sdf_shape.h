#pragma once

#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/import/sdf/missing_files.h"
#include "canopeer/import/sdf/model_paths.h"
#include "canopeer/import/sdf/sdf_element.h"
#include "canopeer/import/sdf/sdf_world.h"

namespace canopeer {

/// Fills in geometry and material of `visual` from a <visual>. False: it has no shape, or one of a
/// kind that cannot be shown; then a notice has been added; or a mesh that is not there, which has
/// been added to `missing`. Error: file, line, and what is no number.
[[nodiscard]] Expected<bool> read_sdf_shape(const SdfElement& from, const ModelPaths& paths,
                                            SdfVisual* visual, std::vector<std::string>* notices,
                                            MissingFiles* missing);

}  // namespace canopeer
