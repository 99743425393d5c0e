#pragma once

#include <vector>

#include "canopeer/cdr/messages/visualization_msgs.h"
#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer::ros {

/// Fruits as they are fitted: first a marker that deletes all before, then two a fruit, with its
/// id: "shapes" (triangles of the superellipsoid, in the colour of its ripeness, the fainter the
/// less sure) and "names" (number, volume, confidence above it). `header.frame_id` is the world.
[[nodiscard]] visualization_msgs::MarkerArray fruit_markers(
    const std::vector<FruitEstimate>& fruits, const std_msgs::Header& header);

}  // namespace canopeer::ros
