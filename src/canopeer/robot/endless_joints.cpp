#include "canopeer/robot/endless_joints.h"

namespace canopeer {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Whole turns that bring `angle` nearest to `reference`, rad.
double turns_towards(double angle, double reference) {
  return kTurn * std::round((reference - angle) / kTurn);
}

}  // namespace

EndlessJoints::EndlessJoints(const JointLimits& limits) {
  for (int i = 0; i < limits.lower.size(); ++i) {
    if (std::isinf(limits.lower[i]) && std::isinf(limits.upper[i])) mask_ |= 1U << i;
  }
}

Configuration EndlessJoints::nearest(const Configuration& q, const Configuration& reference) const {
  Configuration near = q;
  if (!any()) return near;
  for (int i = 0; i < q.size(); ++i) {
    if ((*this)[i]) near[i] += turns_towards(q[i], reference[i]);
  }
  return near;
}

Configuration EndlessJoints::goal(const Configuration& start, const Configuration& a,
                                  const Configuration& b) const {
  Configuration to = nearest(b, a);
  if (!any()) return to;
  for (int i = 0; i < to.size(); ++i) {
    if ((*this)[i]) to[i] += turns_towards(a[i], start[i]);
  }
  return to;
}

}  // namespace canopeer
