#pragma once

#include <vector>

#include "canopeer/cdr/messages/vision_msgs.h"
#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer::ros {

/// One detection a fruit: the box around its shape (in its own axes), one hypothesis "ripe",
/// "turning", "green" or "fruit" (nobody said) with its confidence and the covariance of its
/// centre, `id` the fruit's. `header.frame_id` is the world.
[[nodiscard]] vision_msgs::Detection3DArray fruit_detections(
    const std::vector<FruitEstimate>& fruits, const std_msgs::Header& header);

}  // namespace canopeer::ros
