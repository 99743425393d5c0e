#pragma once

#include <optional>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/pose_source.h"
#include "canopeer/sensing/trajectory.h"

namespace canopeer {

/// Points that a sensor saw, in its own frame, and where it was.
struct SeenFrom {
  std::vector<Eigen::Vector3f> points;
  Pose T_world_sensor = Pose::Identity();
};

/// Whether two frames see the same surfaces at the same place: of the points of one that lie in
/// directions the other has seen, the share that lies on its surface, of those on it or before it
/// (in space that it has seen through). 0 … 1, the mean of both ways; what is hidden behind a
/// surface says nothing. Nothing when they share too little to tell.
[[nodiscard]] std::optional<double> agreement(const SeenFrom& a, const SeenFrom& b);

/// Two frames of a recording whose cameras stood a little apart.
struct FramePair {
  SeenFrom a, b;
};

/// Whether the pairs look alike under the poses, and if the quaternions were read as qw qx qy qz.
struct PoseVerdict {
  int pairs = 0;  ///< that tell something under both
  double as_read = 0.0;
  double w_first = 0.0;

  /// The poses only make sense with qw first.
  [[nodiscard]] bool order_is_wrong() const {
    return pairs >= 2 && as_read < 0.5 && w_first > 0.7 && w_first - as_read > 0.3;
  }
  /// The poses make no sense.
  [[nodiscard]] bool poses_are_odd() const { return pairs >= 2 && as_read < 0.35; }
};
[[nodiscard]] PoseVerdict judge_poses(const std::vector<FramePair>& pairs);

/// The rotation that a quaternion written as qw qx qy qz has, when it was read as qx qy qz qw.
[[nodiscard]] Pose with_w_first(const Pose& pose);

/// Indices of up to `count` pairs of frames, spread over the recording, that lie a hand's breadth
/// or some ten degrees apart, so that both see something in common and a wrong pose shows.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_to_compare(
    const std::vector<Pose>& poses, int count);

/// Adds a notice when the camera moves as none does (faster than 30 m/s or 15 rad/s in more than
/// one step in fifty): units or columns are wrong then.
void add_motion_notice(const Trajectory& trajectory, PoseSource& source);

}  // namespace canopeer
