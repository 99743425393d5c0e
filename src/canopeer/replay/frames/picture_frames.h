#pragma once

#include <vector>

#include "canopeer/detect/detector.h"
#include "canopeer/replay/frame.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::frames {

/// What the camera saw, made small: colour as JPEG, depth as grey PNG (0: no return, else 1 … 255
/// from min_m to max_m), fruit pixels as PNG.
[[nodiscard]] std::vector<Frame> picture_frames(int view, const RgbdFrame& frame,
                                                const Detection& detection);

}  // namespace canopeer::frames
