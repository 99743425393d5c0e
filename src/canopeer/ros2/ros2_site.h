#pragma once

#include <memory>

#include "canopeer/run/site.h"

namespace canopeer {

/// Adds the site `ros2`: a robot spoken to by ROS 2, as the mission's settings `ros2` say. Nothing
/// happens when there is one of that name.
void add_ros2_site(SiteRegistry& sites);

/// Joins the network and waits, as long as settings say, for all that the mission needs: joint
/// states, controllers, camera, clock. The error lists all that is missing, and what is there in
/// its place; or a setting is wrong. Nothing moves before the mission does.
[[nodiscard]] Expected<std::unique_ptr<Site>> make_ros2_site(const SiteRequest& request);

}  // namespace canopeer
