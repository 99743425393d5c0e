#pragma once

#include <vector>

#include "canopeer/viewgraph/segment_frame.h"

namespace canopeer {

/// Where the row lies, seen from a workspace. Indices are of axes of the arm base frame.
struct RowAhead {
  int depth = 1;                 ///< horizontal axis across the row
  int along = 0;                 ///< the other horizontal axis
  Vec3 forward = Vec3::UnitY();  ///< unit, at the row, arm base frame
  double plane_m = 0.0;          ///< on `depth`: where a camera that looks at it stands
};

/// The row is ahead on the horizontal axis along which the two boxes (both in the arm base frame)
/// lie farthest apart. A camera stands `row_distance_m` before the middle of the sampling region,
/// or as near to that as the workspace allows.
[[nodiscard]] RowAhead row_ahead(const Box& workspace_base, const Box& sampling_region_base,
                                 double row_distance_m);

/// Unit vectors of the passes of a scan, arm base frame: straight at the row, then turned by
/// `tilt_rad` to the left, to the right, up and down; with no tilt the first alone would do.
[[nodiscard]] std::vector<Vec3> scan_directions(const RowAhead& row, double tilt_rad);

/// A segment's sampling region in the arm base frame.
[[nodiscard]] Box sampling_region_base(const SegmentFrame& segment);

}  // namespace canopeer
