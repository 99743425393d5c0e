#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "canopeer/mission/event.h"
#include "canopeer/replay/frame.h"

namespace canopeer::frames {

/// The view graph as it grows, and the path through it.
class PlanFrames {
 public:
  /// `planned.sketch` must be there.
  [[nodiscard]] Frame plan(const Planned& planned);

 private:
  using EdgeIds = std::pair<std::int32_t, std::int32_t>;
  int segment_ = -1;
  std::map<std::int32_t, TargetKind> views_;  // told
  std::vector<EdgeIds> edges_;                // told, sorted
  std::vector<std::int32_t> visited_;         // told, ascending
};

}  // namespace canopeer::frames
