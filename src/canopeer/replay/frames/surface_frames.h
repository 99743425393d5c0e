#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "canopeer/fruit/fruit_map.h"
#include "canopeer/replay/frame.h"

namespace canopeer::frames {

/// Points of the surface of each fruit that has changed since the last time.
class SurfaceFrames {
 public:
  /// No frame where nothing has changed.
  [[nodiscard]] std::vector<Frame> surface(double t_s, const SurfaceMesh& mesh);

 private:
  std::map<int, std::uint64_t> told_;  ///< what of a fruit's points, by its id
};

}  // namespace canopeer::frames
