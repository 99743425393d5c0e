#include "canopeer/ros2/robot/joint_curve.h"

#include <algorithm>

namespace canopeer::ros {
namespace {

using trajectory_msgs::JointTrajectory;
using trajectory_msgs::JointTrajectoryPoint;

double seconds_of(const builtin_interfaces::Duration& d) { return d.sec + d.nanosec * 1e-9; }

/// For each joint its place in the trajectory.
Expected<std::vector<std::size_t>> places_of(const std::vector<std::string>& names,
                                             const std::vector<std::string>& given) {
  if (given.size() != names.size()) {
    return fail("joints on incoming trajectory don't match the controller joints");
  }
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(given.begin(), given.end(), name);
    if (found == given.end()) return fail("joint '" + name + "' is not in the trajectory");
    places.push_back(static_cast<std::size_t>(found - given.begin()));
  }
  return places;
}

Expected<Configuration> in_order(const std::vector<double>& values,
                                 const std::vector<std::size_t>& places) {
  if (values.size() != places.size()) return fail("a point has another size than the joints");
  Configuration q(static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    q[static_cast<Eigen::Index>(i)] = values[places[i]];
  if (!q.allFinite()) return fail("a point is no number");
  return q;
}

}  // namespace

Expected<JointCurve> JointCurve::make(const JointTrajectory& trajectory,
                                      const std::vector<std::string>& names,
                                      const JointsState& now) {
  if (trajectory.points.empty()) return fail("empty trajectory received");
  const auto places = places_of(names, trajectory.joint_names);
  if (!places) return tl::unexpected(places.error());
  JointCurve curve;
  for (const JointTrajectoryPoint& point : trajectory.points) {
    Knot knot;
    knot.time_s = seconds_of(point.time_from_start);
    if (knot.time_s < 0.0 || (!curve.knots_.empty() && knot.time_s <= curve.knots_.back().time_s)) {
      return fail("time between points is not strictly increasing");
    }
    auto position = in_order(point.positions, *places);
    if (!position) return tl::unexpected(position.error());
    knot.state = {*position, Configuration::Zero(position->size())};
    if (!point.velocities.empty()) {
      auto velocity = in_order(point.velocities, *places);
      if (!velocity) return tl::unexpected(velocity.error());
      knot.state.velocity = *velocity;
      knot.with_velocity = true;
    }
    curve.knots_.push_back(std::move(knot));
  }
  curve.first_ = curve.knots_.front().state.position;
  if (curve.knots_.front().time_s > 0.0) {
    curve.knots_.insert(curve.knots_.begin(), {0.0, now, curve.knots_.front().with_velocity});
  }
  return curve;
}

JointCurve JointCurve::standing(const Configuration& q) {
  JointCurve curve;
  curve.first_ = q;
  curve.knots_.push_back({0.0, {q, Configuration::Zero(q.size())}, true});
  return curve;
}

JointsState JointCurve::at(double time_s) const {
  if (time_s >= duration_s()) {
    const Configuration& end = knots_.back().state.position;
    return {end, Configuration::Zero(end.size())};
  }
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time_s,
                                      [](double t, const Knot& k) { return t < k.time_s; });
  if (after == knots_.begin()) return knots_.front().state;
  const Knot& a = *(after - 1);
  const Knot& b = *after;
  const double span = b.time_s - a.time_s;
  const double s = (time_s - a.time_s) / span;
  const Configuration way = b.state.position - a.state.position;
  if (!a.with_velocity || !b.with_velocity) {
    return {a.state.position + s * way, way / span};
  }
  // The cubic with these positions and velocities at its ends (Hermite).
  const Configuration& va = a.state.velocity;
  const Configuration& vb = b.state.velocity;
  const Configuration c2 = 3.0 * way - span * (2.0 * va + vb);
  const Configuration c3 = -2.0 * way + span * (va + vb);
  return {a.state.position + s * (span * va + s * (c2 + s * c3)),
          va + (s / span) * (2.0 * c2 + 3.0 * s * c3)};
}

}  // namespace canopeer::ros
