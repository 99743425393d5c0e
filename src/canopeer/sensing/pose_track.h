#pragma once

#include <optional>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/camera_twist.h"

namespace canopeer {

/// Where a camera was at a time, and how it moved then.
struct TrackPoint {
  double time_s = 0.0;
  Pose T_world_camera = Pose::Identity();
  CameraTwist twist;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(time_s, T_world_camera, twist.linear, twist.angular);
  }
};

/// Where a camera was between the times it was asked for.
class PoseTrack {
 public:
  /// Points at the same time count once.
  explicit PoseTrack(std::vector<TrackPoint> points);

  /// From one point to the next as both foretell it, smoothly: exact at the points, in pose and in
  /// twist. Nothing: the nearest is farther than `kReach_s` away.
  [[nodiscard]] std::optional<Pose> at(double time_s) const;

  static constexpr double kReach_s = 0.165;

 private:
  std::vector<TrackPoint> points_;  // by time
};

}  // namespace canopeer
