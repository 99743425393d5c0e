#include "canopeer/sensing/hand_eye.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "canopeer/sensing/alignment/frame_disagreement.h"

namespace canopeer {
namespace {

/// Distances up to which surfaces may be one, from a first rough fit to the last.
constexpr std::array<double, 5> kGates_m = {0.06, 0.04, 0.025, 0.015, 0.01};
constexpr int kStepsPerGate = 6;
constexpr double kShownGate_m = 0.06;  // of residuals that are told
constexpr int kLeastPoints = 50;       // a pair has in common
/// What is believed before anything was seen: it holds what frames cannot tell.
constexpr double kPrior_m = 0.05, kPrior_rad = 0.1, kPrior_s = 0.2;
/// Frames tell something when they know it this much better than that.
constexpr double kKnown = 0.1;

struct Assumption {
  Pose T_said_true = Pose::Identity();
  double time_offset_s = 0.0;
};

struct Pair {
  std::size_t a = 0, b = 0;
};

/// The frames that have poses, and the pairs that see the same.
class Comparison {
 public:
  Comparison(const std::vector<HandEyeFrame>& frames, const CameraPoseAt& pose_at,
             const HandEyeOptions& options)
      : frames_(frames), pose_at_(pose_at), options_(options) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const CameraIntrinsics& k = frames[i].intrinsics;
      const int step = std::max(1, static_cast<int>(std::lround(k.fx / 150.0)));
      patches_.emplace_back(k, frames[i].depth, step);
    }
  }

  /// Where the cameras were; nothing: a pose is not known then.
  [[nodiscard]] std::optional<SoughtPose> pose_of(std::size_t frame, double time_offset_s) const {
    constexpr double kStep_s = 0.01;
    const double t = frames_[frame].time_s + time_offset_s;
    const auto now = pose_at_(t), before = pose_at_(t - kStep_s), after = pose_at_(t + kStep_s);
    if (!now) return std::nullopt;
    SoughtPose pose;
    pose.T_world_said = *now;
    const Pose first = before.value_or(*now), last = after.value_or(*now);
    const double time_s = kStep_s * ((before ? 1 : 0) + (after ? 1 : 0));
    if (time_s == 0.0) return pose;
    const Eigen::Matrix3d R = now->linear().transpose();
    pose.velocity = R * (last.translation() - first.translation()) / time_s;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(first.linear().transpose() * last.linear()));
    pose.turning = R * first.linear() * turn.axis() * turn.angle() / time_s;
    return pose;
  }

  [[nodiscard]] std::vector<std::optional<SoughtPose>> poses(double time_offset_s) const {
    std::vector<std::optional<SoughtPose>> poses;
    for (std::size_t i = 0; i < frames_.size(); ++i) poses.push_back(pose_of(i, time_offset_s));
    return poses;
  }

  /// Pairs that see something in common; more than wanted are thinned evenly.
  void find_pairs() {
    constexpr int kFewPatches = 16;
    const auto at = poses(0.0);
    std::vector<Pair> all;
    for (std::size_t a = 0; a < at.size(); ++a) {
      for (std::size_t b = 0; b < at.size(); ++b) {
        if (a == b || !at[a] || !at[b]) continue;
        const HandEyeSums sums = disagreement(patches_[a], *at[a], patches_[b], *at[b],
                                              Pose::Identity(), kGates_m.front(), kFewPatches);
        if (sums.points * kFewPatches >= kLeastPoints) all.push_back({a, b});
      }
    }
    const std::size_t wanted = static_cast<std::size_t>(options_.max_pairs);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all.size() <= wanted || i * wanted / all.size() != (i + 1) * wanted / all.size()) {
        pairs_.push_back(all[i]);
      }
    }
  }

  /// The sums of each pair, or of every so many; of one without poses: nothing.
  [[nodiscard]] std::vector<HandEyeSums> sums(const Assumption& assumed, double gate_m,
                                              std::size_t every = 1) const {
    const auto at = poses(assumed.time_offset_s);
    std::vector<HandEyeSums> sums;
    for (std::size_t i = 0; i < pairs_.size(); i += every) {
      const auto [a, b] = pairs_[i];
      sums.emplace_back();
      if (!at[a] || !at[b]) continue;
      sums.back() = disagreement(patches_[a], *at[a], patches_[b], *at[b], assumed.T_said_true,
                                 gate_m, stride_of(a));
    }
    return sums;
  }

  /// Distances of each frame's points to the other frames' surfaces.
  [[nodiscard]] std::vector<std::vector<float>> distances(const Assumption& assumed) const {
    const auto at = poses(assumed.time_offset_s);
    std::vector<std::vector<float>> distances(frames_.size());
    for (const auto& [a, b] : pairs_) {
      if (!at[a] || !at[b]) continue;
      add_distances(patches_[a], *at[a], patches_[b], *at[b], assumed.T_said_true, kShownGate_m,
                    stride_of(a), &distances[a]);
    }
    return distances;
  }

  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
  [[nodiscard]] std::size_t frames() const { return frames_.size(); }

 private:
  /// So that a pair has about as many patches as wanted.
  [[nodiscard]] int stride_of(std::size_t frame) const {
    return 1 + static_cast<int>(patches_[frame].all().size()) / options_.patches;
  }

  const std::vector<HandEyeFrame>& frames_;
  const CameraPoseAt& pose_at_;
  const HandEyeOptions& options_;
  std::vector<SurfacePatches> patches_;
  std::vector<Pair> pairs_;
};

/// The mean cost of a point, 0 … 1.
double mean_cost(const std::vector<HandEyeSums>& sums) {
  double cost = 0.0;
  int sought = 0;
  for (const HandEyeSums& pair : sums) {
    cost += pair.cost;
    sought += pair.sought;
  }
  return sought == 0 ? 1.0 : cost / sought;
}

HandEyeMatrix prior_matrix() {
  HandEyeVector precision;
  precision << Vec3::Constant(1.0 / (kPrior_m * kPrior_m)),
      Vec3::Constant(1.0 / (kPrior_rad * kPrior_rad)), 1.0 / (kPrior_s * kPrior_s);
  return precision.asDiagonal();
}

/// Solves A x = b, A symmetric and positive. Its size is said at run time: unrolled for six and for
/// seven rows this file took as long to compile as ten others.
class Equations {
 public:
  explicit Equations(const Eigen::MatrixXd& a) : factors_(a) {}
  [[nodiscard]] Eigen::VectorXd solved(const Eigen::VectorXd& b) const { return factors_.solve(b); }
  [[nodiscard]] bool sound() const { return (factors_.vectorD().array() > 0.0).all(); }

 private:
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

/// Where an assumption lies from none.
HandEyeVector vector_of(const Assumption& assumed) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(assumed.T_said_true.linear()));
  HandEyeVector vector;
  vector << assumed.T_said_true.translation(), turn.axis() * turn.angle(), assumed.time_offset_s;
  return vector;
}

Assumption moved(const Assumption& assumed, const HandEyeVector& step, double max_offset_s) {
  Assumption other = assumed;
  const Vec3 turn = step.segment<3>(3);
  Pose small = Pose::Identity();
  if (turn.norm() > 0.0) {
    small.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  small.translation() = step.head<3>();
  other.T_said_true = assumed.T_said_true * small;
  other.time_offset_s = std::clamp(assumed.time_offset_s + step[6], -max_offset_s, max_offset_s);
  return other;
}

/// The time offset at which frames agree best when the mounting is right.
double best_time(const Comparison& comparison, double max_offset_s) {
  constexpr double kStep_s = 0.03;
  constexpr std::size_t kEveryPair = 4;
  const auto cost_at = [&](double time_s) {
    return mean_cost(comparison.sums({Pose::Identity(), time_s}, kGates_m[1], kEveryPair));
  };
  double best_s = 0.0;
  double best_cost = cost_at(0.0);
  for (double t = -max_offset_s; t <= max_offset_s + 1e-9; t += kStep_s) {
    const double cost = cost_at(t);
    if (cost >= best_cost - 1e-3) continue;
    best_cost = cost;
    best_s = t;
  }
  return best_s;
}

/// What is sought; the rest stays as it is assumed.
enum class Sought { all, mounting, time };

/// Gauss–Newton steps under ever narrower gates, from the given one on.
Assumption fit(const Comparison& comparison, Assumption assumed, double max_offset_s,
               std::size_t first_gate, Sought sought = Sought::all) {
  for (std::size_t g = first_gate; g < kGates_m.size(); ++g) {
    const double gate_m = kGates_m[g];
    const double small_step = gate_m == kGates_m.back() ? 2e-5 : 5e-4;
    for (int i = 0; i < kStepsPerGate; ++i) {
      HandEyeMatrix matrix = prior_matrix();
      HandEyeVector gradient = matrix * vector_of(assumed);
      for (const HandEyeSums& pair : comparison.sums(assumed, gate_m)) {
        matrix += pair.matrix;
        gradient += pair.gradient;
      }
      HandEyeVector step = HandEyeVector::Zero();
      if (sought == Sought::time) {
        step[6] = -gradient[6] / matrix(6, 6);
      } else if (sought == Sought::mounting) {
        step.head<6>() = -Equations(matrix.topLeftCorner<6, 6>()).solved(gradient.head<6>());
      } else {
        step = -Equations(matrix).solved(gradient);
      }
      assumed = moved(assumed, step, max_offset_s);
      if (step.norm() < small_step) break;
    }
  }
  return assumed;
}

/// Of fits from far and from near the one under which more agrees: leaves all look alike, and from
/// afar some meet others.
Assumption best_fit(const Comparison& comparison, double max_offset_s) {
  constexpr std::size_t kNarrow = 3;
  const double start_s = best_time(comparison, max_offset_s);
  const Assumption far = fit(comparison, {Pose::Identity(), start_s}, max_offset_s, 0);
  const Assumption near = fit(comparison, {}, max_offset_s, kNarrow);
  const auto cost = [&](const Assumption& assumed) {
    return mean_cost(comparison.sums(assumed, kGates_m[kNarrow]));
  };
  return cost(near) <= cost(far) ? near : far;
}

/// Covariance of what was found (Huber's sandwich). Points of a pair err alike, and so do pairs
/// that share a frame: frames are counted.
HandEyeMatrix covariance(const Comparison& comparison, const std::vector<HandEyeSums>& sums) {
  HandEyeMatrix curvature = prior_matrix(), spread = prior_matrix();
  std::vector<HandEyeVector> of_frame(comparison.frames(), HandEyeVector::Zero());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    curvature += sums[i].curvature;
    of_frame[comparison.pairs()[i].a] += sums[i].gradient;
    of_frame[comparison.pairs()[i].b] += sums[i].gradient;
  }
  for (const HandEyeVector& gradient : of_frame) spread += gradient * gradient.transpose();
  const Equations equations(curvature);
  if (!equations.sound()) {  // it tells nothing
    return prior_matrix().diagonal().cwiseInverse().asDiagonal();
  }
  HandEyeMatrix inverse;
  for (int i = 0; i < 7; ++i) inverse.col(i) = equations.solved(HandEyeVector::Unit(i));
  return inverse * spread * inverse;
}

double largest_error(const Eigen::Matrix3d& covariance) {
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[2]));
}

double median(std::vector<float>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// How far apart surfaces lie that should be one, in the middle.
double median_distance(const Comparison& comparison, const Assumption& assumed) {
  std::vector<float> all;
  for (const auto& frame : comparison.distances(assumed)) {
    all.insert(all.end(), frame.begin(), frame.end());
  }
  return median(all);
}

/// Whether frames agree clearly better with all that was found than with the best of one kind
/// alone: leaves move a fit by more than its standard error where few surfaces meet.
bool explains(const Comparison& comparison, double after_m, Sought alone, double max_offset_s) {
  constexpr std::size_t kGate = 1;
  constexpr double kShare = 0.93;
  const Assumption other = fit(comparison, {}, max_offset_s, kGate, alone);
  return after_m < kShare * median_distance(comparison, other);
}

void tell_residuals(const Comparison& comparison, const Assumption& found,
                    HandEyeEstimate* estimate) {
  auto before = comparison.distances({});
  auto after = comparison.distances(found);
  std::vector<float> all_before, all_after;
  for (std::size_t i = 0; i < after.size(); ++i) {
    all_before.insert(all_before.end(), before[i].begin(), before[i].end());
    all_after.insert(all_after.end(), after[i].begin(), after[i].end());
    const int points = static_cast<int>(after[i].size());
    estimate->frames.push_back({median(before[i]), median(after[i]), points});
  }
  const int points = static_cast<int>(all_after.size());
  estimate->all = {median(all_before), median(all_after), points};
}

}  // namespace

Expected<HandEyeEstimate> estimate_hand_eye(const std::vector<HandEyeFrame>& frames,
                                            const CameraPoseAt& pose_at,
                                            const HandEyeOptions& options) {
  Comparison comparison(frames, pose_at, options);
  constexpr std::size_t kLeastPairs = 4;
  comparison.find_pairs();
  if (comparison.pairs().size() < kLeastPairs) {
    return fail(
        "the frames have too little surface in common: take more of them, closer together, "
        "of something with flat parts 0.3 to 1.5 m away");
  }
  const Assumption found = best_fit(comparison, options.max_time_offset_s);

  HandEyeEstimate estimate;
  estimate.T_said_true = found.T_said_true;
  estimate.time_offset_s = found.time_offset_s;
  estimate.translation_m = found.T_said_true.translation().norm();
  estimate.rotation_rad = Eigen::AngleAxisd(Eigen::Matrix3d(found.T_said_true.linear())).angle();
  const HandEyeMatrix errors = covariance(comparison, comparison.sums(found, kGates_m.back()));
  estimate.translation_se_m = largest_error(errors.topLeftCorner<3, 3>());
  estimate.rotation_se_rad = largest_error(errors.block<3, 3>(3, 3));
  estimate.time_offset_se_s = std::sqrt(errors(6, 6));
  estimate.hand_eye_known = estimate.translation_se_m < kKnown * kPrior_m &&
                            estimate.rotation_se_rad < kKnown * kPrior_rad;
  estimate.time_known = estimate.time_offset_se_s < kKnown * kPrior_s;
  tell_residuals(comparison, found, &estimate);
  const auto wrong = [](double error, double standard_error, double worth) {
    return error > std::max(worth, 3.0 * standard_error);
  };
  const auto needed_beside = [&](Sought alone) {
    return explains(comparison, estimate.all.after_m, alone, options.max_time_offset_s);
  };
  estimate.hand_eye_wrong =
      estimate.hand_eye_known &&
      (wrong(estimate.translation_m, estimate.translation_se_m, options.worth_m) ||
       wrong(estimate.rotation_rad, estimate.rotation_se_rad, options.worth_rad)) &&
      needed_beside(Sought::time);
  estimate.time_wrong =
      estimate.time_known &&
      wrong(std::abs(estimate.time_offset_s), estimate.time_offset_se_s, options.worth_s) &&
      needed_beside(Sought::mounting);
  return estimate;
}

}  // namespace canopeer
