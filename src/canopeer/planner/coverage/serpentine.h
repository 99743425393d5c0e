#pragma once

#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/viewgraph/segment_frame.h"

namespace canopeer {

/// Where the camera stands in a fixed scan, and how it is turned.
struct SerpentineOptions {
  double spacing_m = 0.3;        ///< between neighbouring camera positions, at most
  double row_distance_m = 0.6;   ///< from the camera to the middle of the sampling region, at least
  double tilt_rad = 0.5;         ///< of the later passes: left, right, up, down
  double look_distance_m = 0.5;  ///< how far in front of the camera the point it looks at is
};

/// A camera position and the point it looks at, both in the arm base frame.
struct FixedView {
  Vec3 camera_base = Vec3::Zero();
  Vec3 target_base = Vec3::Zero();
};

/// A fixed scan of a segment: positions on a vertical plane of the workspace, line by line from the
/// top, every other line backwards, facing the row (row_ahead.h); then the same again tilted left,
/// right, up and down. Both boxes are in the arm base frame.
[[nodiscard]] std::vector<FixedView> serpentine(const Box& workspace_base,
                                                const Box& sampling_region_base,
                                                const SerpentineOptions& options);
/// The one of a segment.
[[nodiscard]] std::vector<FixedView> serpentine(const SegmentFrame& segment,
                                                const SerpentineOptions& options);

}  // namespace canopeer
