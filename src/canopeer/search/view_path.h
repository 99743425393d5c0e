#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/viewgraph/view_graph.h"

namespace canopeer {

/// One stop on a view path.
struct PathStep {
  NodeId node{};
  double time_s = 0.0;  ///< execution time of the edge that leads here
  std::int64_t new_unknown =
      0;  ///< distinct unknown voxels seen here and at no earlier stop of the path

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(node, time_s, new_unknown);
  }
};

/// A sequence of views to take, without the node the camera is at. Empty: nothing to go for.
struct ViewPath {
  std::vector<PathStep> steps;
  double utility = 0.0;  ///< U of the last step, eq. (1) of [Zaenker23]; voxels per second
};

}  // namespace canopeer
