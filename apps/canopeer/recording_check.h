#pragma once

#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "recording.h"

namespace canopeer::app {

/// Looks at a few frames before all are fused: whether surfaces that several saw lie at the same
/// place under the poses, and whether the camera writes a depth where it has none. Returns notices;
/// the error says that only another order of the quaternions makes sense.
[[nodiscard]] Expected<std::vector<std::string>> check_recording(const Recording& recording);

}  // namespace canopeer::app
