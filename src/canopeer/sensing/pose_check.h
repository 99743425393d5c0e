#pragma once

#include <optional>
#include <utility>
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

/// How far pairs of frames agree, on average.
struct PairAgreement {
  int pairs = 0;       ///< that tell something
  double share = 0.0;  ///< 0 … 1
};

/// How far the pairs agree under the poses, and under what the poses may mean instead.
struct PoseVerdict {
  bool order_is_said = false;  ///< of quaternions: then w_first is no explanation
  PairAgreement as_read;
  PairAgreement w_first;   ///< see with_w_first()
  PairAgreement mirrored;  ///< see mirrored()

  [[nodiscard]] bool order_is_wrong() const {
    return !order_is_said && only(w_first) && w_first.share >= mirrored.share;
  }
  [[nodiscard]] bool left_handed() const {
    return only(mirrored) && (order_is_said || mirrored.share > w_first.share);
  }
  /// The poses make no sense, or only what the file says they are not makes sense.
  [[nodiscard]] bool poses_are_odd() const {
    return (as_read.pairs >= 2 && as_read.share < 0.45) || (order_is_said && only(w_first));
  }

 private:
  [[nodiscard]] bool only(const PairAgreement& other) const {
    return as_read.pairs >= 2 && other.pairs >= 2 && as_read.share < 0.75 && other.share > 0.75 &&
           other.share - as_read.share > 0.25;
  }
};
/// `order_is_said`: see PoseSource.
[[nodiscard]] PoseVerdict judge_poses(const std::vector<FramePair>& pairs,
                                      bool order_is_said = false);

/// The rotation that a quaternion written as qw qx qy qz has, when it was read as qx qy qz qw.
[[nodiscard]] Pose with_w_first(const Pose& pose);

/// The pose when the y axes of sensor and world point the other way: a left-handed pose (of a
/// renderer whose camera has y up) becomes a right-handed one.
[[nodiscard]] Pose mirrored(const Pose& pose);

/// Indices of up to `count` pairs of frames, spread over the recording, that lie a hand's breadth
/// or some ten degrees apart, so that both see something in common and a wrong pose shows.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_to_compare(
    const std::vector<Pose>& poses, int count);

/// Adds a notice when the camera moves as none does (faster than 30 m/s or 15 rad/s in more than
/// one step in fifty): units or columns are wrong then.
void add_motion_notice(const Trajectory& trajectory, PoseSource& source);

}  // namespace canopeer
