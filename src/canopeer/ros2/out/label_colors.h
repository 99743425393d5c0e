#pragma once

#include "canopeer/sensing/image.h"
#include "canopeer/sensing/rgbd_frame.h"
#include "canopeer/viewgraph/view_pose.h"

// The same thing has the same colour in every message.

namespace canopeer::ros {

/// Fruits by ripeness; background: nobody said.
[[nodiscard]] constexpr Rgb label_color(PixelLabel label) {
  switch (label) {
    case PixelLabel::green_fruit:
      return {70, 170, 60};
    case PixelLabel::turning_fruit:
      return {245, 150, 40};
    case PixelLabel::ripe_fruit:
      return {214, 54, 38};
    case PixelLabel::background:
      break;
  }
  return {200, 80, 180};
}

/// Views by what they look at.
[[nodiscard]] constexpr Rgb target_color(TargetKind kind) {
  switch (kind) {
    case TargetKind::roi:
      return {214, 54, 38};
    case TargetKind::occupied:
      return {96, 140, 84};
    case TargetKind::border:
      return {70, 120, 200};
    case TargetKind::none:
      break;
  }
  return {150, 150, 150};
}

}  // namespace canopeer::ros
