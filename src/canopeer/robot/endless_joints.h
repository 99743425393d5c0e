#pragma once

#include <cmath>
#include <cstdint>

#include "canopeer/robot/joint_limits.h"

namespace canopeer {

/// Which joints of an arm turn without end: revolute, with no limits (decision 47). Their positions
/// are real numbers that run on beyond ±π. Positions that whole turns lie between are one place. A
/// motion is a straight line between real numbers, so whoever joins two places takes for the second
/// the configuration nearest() to the first. Everything after that (checks, timing, execution)
/// needs to know nothing of turns.
class EndlessJoints {
 public:
  EndlessJoints() = default;  ///< none
  explicit EndlessJoints(const JointLimits& limits);

  [[nodiscard]] bool any() const { return mask_ != 0; }
  [[nodiscard]] bool operator[](int joint) const { return ((mask_ >> joint) & 1U) != 0; }

  /// The same place as `q`, each endless joint no more than half a turn from `reference`.
  [[nodiscard]] Configuration nearest(const Configuration& q, const Configuration& reference) const;

  /// Where a motion from `start` ends that goes as the one from `a` to `b` does: the shorter way
  /// round. `start` and `a` are one place. With `start` = `a` it is nearest(b, a); where the halves
  /// are all but equal it still turns the way that was checked for `a` and `b`.
  [[nodiscard]] Configuration goal(const Configuration& start, const Configuration& a,
                                   const Configuration& b) const;

  /// Σ|Δq|, the shorter way round, rad.
  [[nodiscard]] double distance(const Configuration& a, const Configuration& b) const {
    return any() ? distance(a.data(), b) : (a - b).lpNorm<1>();
  }
  /// The same from as many numbers at `a`, which lie elsewhere.
  [[nodiscard]] double distance(const double* a, const Configuration& b) const;

 private:
  std::uint32_t mask_ = 0;
};

inline double EndlessJoints::distance(const double* a, const Configuration& b) const {
  constexpr double kTurn = 6.283185307179586;
  double sum = 0.0;
  for (int i = 0; i < b.size(); ++i) {
    double delta = a[i] - b[i];
    if ((*this)[i]) delta -= kTurn * std::round(delta / kTurn);
    sum += std::abs(delta);
  }
  return sum;
}

}  // namespace canopeer
