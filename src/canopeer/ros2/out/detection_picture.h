#pragma once

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/detect/detector.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::ros {

/// The frame's colours (grey by depth where it has none), fruit pixels tinted in the colour of
/// their label, with an outline: encoding "rgb8". `detection` is of the frame's size or empty.
[[nodiscard]] sensor_msgs::Image detection_picture(const RgbdFrame& frame,
                                                   const Detection& detection,
                                                   const std_msgs::Header& header);

}  // namespace canopeer::ros
