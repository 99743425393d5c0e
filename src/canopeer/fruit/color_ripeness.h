#pragma once

#include <vector>

#include "canopeer/sensing/image.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// How ripe a spot of fruit surface of this colour is, by its HSV hue: red (−30° … 14.5°) is ripe,
/// orange and yellow (up to 50°) turning, green (up to 170°) green. The first two limits are those
/// of the colour detector. Background: no such hue, too pale (saturation below 0.2) or too dark
/// (value below 0.1) to tell.
[[nodiscard]] PixelLabel ripeness_of_color(const Rgb& color);

/// What most of those spots are that tell; background when fewer than one in five do.
[[nodiscard]] PixelLabel ripeness_of_surface(const std::vector<Rgb>& colors);

}  // namespace canopeer
