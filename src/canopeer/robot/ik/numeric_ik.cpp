#include "canopeer/robot/ik/numeric_ik.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr int kTableSize = 2048;
constexpr int kMaxStarts = 32;
constexpr float kMetresPerRadian = 0.3F;  // how far off a camera's axis is, next to how far away
constexpr int kMaxIterations = 40;
constexpr int kPatience = 4;           // steps in a row that do not halve the error
constexpr double kConverged = 1e-9;    // m and rad
constexpr double kGiveUpAbove = 0.05;  // error after a while that no good end comes of
constexpr double kLongestStep = 0.6;   // rad or m, any joint
constexpr double kDistinct = 0.1;      // solutions nearer to each other count once

/// Turn that brings `from` onto `to`, as axis times angle; unit vectors.
Vec3 turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double sine = axis.norm();
  const double cosine = from.dot(to);
  if (sine < 1e-12) return cosine > 0.0 ? Vec3(Vec3::Zero()) : Vec3(3.1 * from.unitOrthogonal());
  return axis * (std::atan2(sine, cosine) / sine);
}

Vec3 turn_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::Matrix3d R = to * from.transpose();
  const Vec3 twice_sine_axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = twice_sine_axis.norm() / 2.0;
  const double angle = std::atan2(sine, (R.trace() - 1.0) / 2.0);
  if (sine > 1e-9) return twice_sine_axis * (angle / (2.0 * sine));
  if (angle < 1.0) return twice_sine_axis / 2.0;
  const Eigen::AngleAxisd half_turn(R);
  return half_turn.angle() * half_turn.axis();
}

/// Δq = Jᵀ (J Jᵀ + λ)⁻¹ e of the first n rows of J, by Cholesky's A = L Lᵀ. Plain loops: with
/// Eigen's products and solvers of these sizes this file takes the compiler twice as long.
template <std::size_t n>
void damped_step(const RobotModel::Jacobian& J, const std::array<double, n>& error, double damping,
                 Configuration& step) {
  const auto joints = static_cast<int>(J.cols());
  const auto at = [&J](std::size_t row, int i) { return J(static_cast<int>(row), i); };
  std::array<std::array<double, n>, n> L;  // the lower half
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c <= r; ++c) {
      double rest = r == c ? damping : 0.0;
      for (int i = 0; i < joints; ++i) rest += at(r, i) * at(c, i);
      for (std::size_t k = 0; k < c; ++k) rest -= L[r][k] * L[c][k];
      L[r][c] = r == c ? std::sqrt(rest) : rest / L[c][c];
    }
  }
  std::array<double, n> x = error;
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t k = 0; k < r; ++k) x[r] -= L[r][k] * x[k];
    x[r] /= L[r][r];
  }
  for (std::size_t r = n; r-- > 0;) {
    for (std::size_t k = r + 1; k < n; ++k) x[r] -= L[k][r] * x[k];
    x[r] /= L[r][r];
  }
  for (int i = 0; i < joints; ++i) {
    step[i] = 0.0;
    for (std::size_t r = 0; r < n; ++r) step[i] += at(r, i) * x[r];
  }
}

}  // namespace

NumericIk::NumericIk(const RobotModel& robot) : robot_(robot) {
  Rng rng(1, "numeric-ik");
  for (int k = 0; k < kTableSize; ++k) {
    Configuration q(robot_.dof());
    for (int i = 0; i < q.size(); ++i)
      q[i] = rng.uniform(robot_.span().lower[i], robot_.span().upper[i]);
    const Pose T = robot_.T_base_camera(q);
    for (int i = 0; i < 3; ++i) {
      camera_[i].push_back(static_cast<float>(T.translation()[i]));
      camera_[3 + i].push_back(static_cast<float>(T.linear()(i, 2)));
    }
    table_.push_back(q);
  }
}

/// Rows of the table with the cameras nearest to the goal's, best first.
int NumericIk::nearest_starts(const Goal& goal, int count, int* rows) const {
  const Eigen::Vector3f p = goal.T_base_camera.translation().cast<float>();
  const Eigen::Vector3f z = goal.T_base_camera.linear().col(2).cast<float>();
  std::array<float, kTableSize> score;
  constexpr float kWeight = kMetresPerRadian * kMetresPerRadian;
  for (std::size_t k = 0; k < kTableSize; ++k) {
    const float dx = camera_[0][k] - p.x();
    const float dy = camera_[1][k] - p.y();
    const float dz = camera_[2][k] - p.z();
    const float ux = camera_[3][k] - z.x();
    const float uy = camera_[4][k] - z.y();
    const float uz = camera_[5][k] - z.z();
    score[k] = dx * dx + dy * dy + dz * dz + kWeight * (ux * ux + uy * uy + uz * uz);
  }
  int found = 0;
  float worst = std::numeric_limits<float>::infinity();
  for (int k = 0; k < kTableSize; ++k) {
    const float own = score[static_cast<std::size_t>(k)];
    if (found == count && own >= worst) continue;
    int place = found < count ? found++ : count - 1;
    for (; place > 0 && score[static_cast<std::size_t>(rows[place - 1])] > own; --place)
      rows[place] = rows[place - 1];
    rows[place] = k;
    worst = score[static_cast<std::size_t>(rows[found - 1])];
  }
  return found;
}

template <int kEquations>
bool NumericIk::converge(const Goal& goal, Configuration& q) const {
  const Configuration& lower = robot_.limits().lower;
  const Configuration& upper = robot_.limits().upper;
  const int dof = robot_.dof();
  Pose T;
  RobotModel::Jacobian J;
  double best = std::numeric_limits<double>::infinity();
  int stuck = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    robot_.camera_jacobian(q, T, J);
    const Vec3 shift = goal.T_base_camera.translation() - T.translation();
    std::array<double, kEquations> error = {shift.x(), shift.y(), shift.z()};
    if constexpr (kEquations == 5) {
      // A turn about the optical axis is free: only the parts along the image's axes count.
      const Vec3 right = T.linear().col(0);
      const Vec3 down = T.linear().col(1);
      const Vec3 turn =
          turn_between(Vec3(T.linear().col(2)), Vec3(goal.T_base_camera.linear().col(2)));
      error[3] = right.dot(turn);
      error[4] = down.dot(turn);
      for (int i = 0; i < dof; ++i) {
        const Vec3 turned(J(3, i), J(4, i), J(5, i));
        J(3, i) = right.dot(turned);
        J(4, i) = down.dot(turned);
      }
    } else {
      const Vec3 turn =
          turn_between(Eigen::Matrix3d(T.linear()), Eigen::Matrix3d(goal.T_base_camera.linear()));
      for (std::size_t k = 0; k < 3; ++k) error[3 + k] = turn[static_cast<int>(k)];
    }
    double square = 0.0;
    for (const double part : error) square += part * part;
    const double size = std::sqrt(square);
    if (size < kConverged) return true;
    stuck = size < 0.5 * best ? 0 : stuck + 1;
    best = std::min(best, size);
    if (stuck > kPatience && size > kGiveUpAbove) return false;
    if (stuck > 3 * kPatience) return false;

    // Columns of joints that a limit holds are left out.
    Configuration step(dof);
    for (int round = 0; round < 3; ++round) {
      damped_step(J, error, 0.5 * square * 1e-2 + 1e-12, step);
      bool held = false;
      for (int i = 0; i < dof; ++i) {
        const bool out = (q[i] <= lower[i] && step[i] < 0.0) || (q[i] >= upper[i] && step[i] > 0.0);
        if (!out) continue;
        for (int row = 0; row < kEquations; ++row) J(row, i) = 0.0;
        held = true;
      }
      if (!held) break;
    }
    double longest = 0.0;
    for (int i = 0; i < dof; ++i) longest = std::max(longest, std::abs(step[i]));
    const double share = longest > kLongestStep ? kLongestStep / longest : 1.0;
    for (int i = 0; i < dof; ++i) q[i] = std::clamp(q[i] + share * step[i], lower[i], upper[i]);
  }
  return false;
}

void NumericIk::search(const Goal& goal, const Configuration& reference, int starts, int solutions,
                       std::vector<Configuration>& out) const {
  int rows[kMaxStarts];
  const int others = nearest_starts(goal, std::clamp(starts - 1, 1, kMaxStarts), rows);
  const std::size_t first = out.size();
  const Configuration& lower = robot_.limits().lower;
  const Configuration& upper = robot_.limits().upper;
  for (int k = -1; k < others && out.size() < first + static_cast<std::size_t>(solutions); ++k) {
    Configuration q = k < 0 ? Configuration(reference.cwiseMax(lower).cwiseMin(upper))
                            : table_[static_cast<std::size_t>(rows[k])];
    if (!(goal.any_roll ? converge<5>(goal, q) : converge<6>(goal, q))) continue;
    for (int i = 0; i < q.size(); ++i) {
      double near = q[i];
      if (robot_.arm_joint_type(i) == JointType::kRevolute &&
          bring_near(near, reference[i], lower[i], upper[i]))
        q[i] = near;
    }
    const bool known = std::any_of(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                                   [&](const Configuration& other) {
                                     const Configuration near = robot_.endless().nearest(other, q);
                                     return (near - q).lpNorm<Eigen::Infinity>() < kDistinct;
                                   });
    if (!known) out.push_back(q);
  }
}

void NumericIk::solve(const Pose& T_base_camera, const Configuration& reference,
                      std::vector<Configuration>& out) const {
  search({T_base_camera, false}, reference, kMaxStarts, kMaxStarts, out);
}

void NumericIk::solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                           std::vector<Configuration>& out, const ViewIkOptions& options) const {
  out.clear();
  search({look_at(position, target), true}, reference, options.numeric_starts,
         options.numeric_solutions, out);
}

}  // namespace canopeer
