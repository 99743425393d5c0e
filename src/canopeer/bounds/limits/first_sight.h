#pragma once

#include <vector>

#include "canopeer/bounds/limits/segment_times.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// By counted fruit, a time before which no part of it has been in front of the camera, whatever
/// the planner does; infinite: never. Nothing is taken to stand in the way.
///
/// For each fruit and segment the quickest configuration that may show it is looked for, from home,
/// by branch and bound over boxes of joint angles: a box is quick as its place nearest to home is,
/// it is dropped when from none of its cameras any part of the fruit lies in the frustum
/// (sight_cell.h), the quickest is halved. At any moment the quickest box left is a bound; `cells`
/// boxes are looked at. With frames on the way the drives from stop to stop are looked along too.
[[nodiscard]] std::vector<double> first_sights_s(const Scene& scene, const RobotModel& robot,
                                                 const MissionOptions& mission,
                                                 const CameraIntrinsics& camera,
                                                 const SegmentTimes& times, int cells);

}  // namespace canopeer
