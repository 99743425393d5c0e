#pragma once

#include "canopeer/cdr/messages/nav_msgs.h"
#include "canopeer/cdr/messages/visualization_msgs.h"
#include "canopeer/planner/plan_sketch.h"

namespace canopeer::ros {

/// What the planner has in mind, each time all of it: "views" (where they are), "axes" (which way
/// they look), both by kind of target, those visited in grey; "edges"; "path" (from where the arm
/// stands). `header.frame_id` is the world.
[[nodiscard]] visualization_msgs::MarkerArray plan_markers(const PlanSketch& sketch,
                                                           const std_msgs::Header& header);

/// The views about to be taken, poses of the optical frame, beginning where the arm stands.
[[nodiscard]] nav_msgs::Path plan_path(const PlanSketch& sketch, const std_msgs::Header& header);

}  // namespace canopeer::ros
