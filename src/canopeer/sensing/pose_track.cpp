#include "canopeer/sensing/pose_track.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canopeer {
namespace {

Eigen::Matrix3d turned_by(const Vec3& turn) {
  const double angle = turn.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

/// With the twist it has; the way is that of the middle, which a circle's chord is parallel to.
Pose foretold(const TrackPoint& from, double time_s) {
  const double dt = time_s - from.time_s;
  Pose moved = Pose::Identity();
  moved.linear() = turned_by(dt * from.twist.angular);
  moved.translation() = turned_by(0.5 * dt * from.twist.angular) * (dt * from.twist.linear);
  return from.T_world_camera * moved;
}

Vec3 velocity_world(const TrackPoint& point) {
  return point.T_world_camera.linear() * point.twist.linear;
}

/// Between two points: a cubic through places and velocities (Hermite); turned as both foretell.
Pose between(const TrackPoint& a, const TrackPoint& b, double time_s) {
  const double span_s = b.time_s - a.time_s;
  const double s = (time_s - a.time_s) / span_s;
  const double smooth = s * s * (3.0 - 2.0 * s);
  const Eigen::Matrix3d from = foretold(a, time_s).linear();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(from.transpose() * foretold(b, time_s).linear()));
  Pose pose = Pose::Identity();
  pose.linear() = from * turned_by(smooth * turn.angle() * turn.axis());
  pose.translation() =
      (1.0 - smooth) * a.T_world_camera.translation() + smooth * b.T_world_camera.translation() +
      s * (1.0 - s) * span_s * ((1.0 - s) * velocity_world(a) - s * velocity_world(b));
  return pose;
}

}  // namespace

PoseTrack::PoseTrack(std::vector<TrackPoint> points) : points_(std::move(points)) {
  const auto earlier = [](const TrackPoint& a, const TrackPoint& b) { return a.time_s < b.time_s; };
  std::stable_sort(points_.begin(), points_.end(), earlier);
  const auto same = [](const TrackPoint& a, const TrackPoint& b) { return a.time_s == b.time_s; };
  points_.erase(std::unique(points_.begin(), points_.end(), same), points_.end());
}

std::optional<Pose> PoseTrack::at(double time_s) const {
  const auto after = std::upper_bound(points_.begin(), points_.end(), time_s,
                                      [](double t, const TrackPoint& p) { return t < p.time_s; });
  const auto near = [&](auto point) { return std::abs(point->time_s - time_s) <= kReach_s; };
  const bool has_after = after != points_.end();
  const bool has_before = after != points_.begin();
  if (has_before && has_after && after->time_s - (after - 1)->time_s <= 2.0 * kReach_s) {
    return between(*(after - 1), *after, time_s);
  }
  if (has_before && near(after - 1)) return foretold(*(after - 1), time_s);
  if (has_after && near(after)) return foretold(*after, time_s);
  return std::nullopt;
}

}  // namespace canopeer
