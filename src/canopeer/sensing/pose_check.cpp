#include "canopeer/sensing/pose_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

namespace canopeer {
namespace {

constexpr double kCell_rad = 1.5 * std::numbers::pi / 180.0;
constexpr double kTolerance = 0.02;    // of the distance
constexpr double kTolerance_m = 0.02;  // and this
constexpr int kMinShared = 60;         // points that two frames have in common
constexpr double kMinShare = 0.02;     // of those of one

/// How far the surface is in each direction: the nearest and the farthest point of each cell.
class RangeMap {
 public:
  explicit RangeMap(const std::vector<Eigen::Vector3f>& points) {
    for (const Eigen::Vector3f& p : points) {
      const double range = static_cast<double>(p.norm());
      if (!(range > 0.0 && std::isfinite(range))) continue;
      const auto [cell, added] = cells_.try_emplace(cell_of(p), range, range);
      if (added) continue;
      cell->second.first = std::min(cell->second.first, range);
      cell->second.second = std::max(cell->second.second, range);
    }
  }

  enum class Place { unseen, before, on, behind };

  [[nodiscard]] Place place_of(const Eigen::Vector3f& p) const {
    const auto cell = cells_.find(cell_of(p));
    if (cell == cells_.end()) return Place::unseen;
    const double range = static_cast<double>(p.norm());
    const auto [nearest, farthest] = cell->second;
    if (range < nearest * (1.0 - kTolerance) - kTolerance_m) return Place::before;
    return range > farthest * (1.0 + kTolerance) + kTolerance_m ? Place::behind : Place::on;
  }

 private:
  using Cell = std::pair<int, int>;
  static Cell cell_of(const Eigen::Vector3f& p) {
    const double across = std::atan2(p.x(), p.z());
    const double down = std::atan2(p.y(), std::hypot(p.x(), p.z()));
    return {static_cast<int>(std::floor(across / kCell_rad)),
            static_cast<int>(std::floor(down / kCell_rad))};
  }

  std::map<Cell, std::pair<double, double>> cells_;
};

std::optional<double> agreement_one_way(const SeenFrom& a, const SeenFrom& b) {
  const RangeMap seen(b.points);
  const Eigen::Isometry3f T_b_a =
      (b.T_world_sensor.inverse(Eigen::Isometry) * a.T_world_sensor).cast<float>();
  int on = 0, before = 0;
  for (const Eigen::Vector3f& p : a.points) {
    const auto place = seen.place_of(T_b_a * p);
    on += place == RangeMap::Place::on;
    before += place == RangeMap::Place::before;
  }
  if (on + before <
      std::max(kMinShared, static_cast<int>(kMinShare * static_cast<double>(a.points.size())))) {
    return std::nullopt;
  }
  return static_cast<double>(on) / (on + before);
}

double angle_between(const Pose& a, const Pose& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

}  // namespace

std::optional<double> agreement(const SeenFrom& a, const SeenFrom& b) {
  const auto one = agreement_one_way(a, b);
  const auto other = agreement_one_way(b, a);
  if (!one || !other) return std::nullopt;
  return 0.5 * (*one + *other);
}

Pose with_w_first(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  Pose other = pose;
  other.linear() = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
  return other;
}

Pose mirrored(const Pose& pose) {
  const Eigen::DiagonalMatrix<double, 3> flip(1.0, -1.0, 1.0);
  Pose other = Pose::Identity();
  other.linear() = flip * pose.linear() * flip;
  other.translation() = flip * pose.translation();
  return other;
}

PoseVerdict judge_poses(const std::vector<FramePair>& pairs, bool order_is_said) {
  const auto under = [&](const auto& meaning) {
    PairAgreement mean;
    for (const auto& [a, b] : pairs) {
      const auto share =
          agreement({a.points, meaning(a.T_world_sensor)}, {b.points, meaning(b.T_world_sensor)});
      if (!share) continue;
      ++mean.pairs;
      mean.share += *share;
    }
    if (mean.pairs > 0) mean.share /= mean.pairs;
    return mean;
  };
  return {order_is_said, under([](const Pose& pose) { return pose; }), under(with_w_first),
          under(mirrored)};
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_to_compare(const std::vector<Pose>& poses,
                                                                  int count) {
  constexpr double kMinAngle = 0.2, kMaxAngle = 0.6;  // rad
  constexpr double kMinWay_m = 0.2, kMaxWay_m = 1.0;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const std::size_t step = std::max<std::size_t>(1, poses.size() / static_cast<std::size_t>(count));
  for (std::size_t a = 0; a < poses.size(); a += step) {
    for (std::size_t b = a + 1; b < poses.size(); ++b) {
      const double angle = angle_between(poses[a], poses[b]);
      const double way = (poses[a].translation() - poses[b].translation()).norm();
      if (angle > kMaxAngle || way > kMaxWay_m) break;
      if (angle < kMinAngle && way < kMinWay_m) continue;
      pairs.emplace_back(a, b);
      break;
    }
  }
  return pairs;
}

void add_motion_notice(const Trajectory& trajectory, PoseSource& source) {
  constexpr double kFast_m_s = 30.0, kFast_rad_s = 15.0;
  constexpr double kMaxShare = 0.02;
  const auto& poses = trajectory.poses();
  std::size_t fast = 0;
  double first_s = 0.0, speed = 0.0, turn = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double time_s = poses[i].time_s - poses[i - 1].time_s;
    const Pose& a = poses[i - 1].T_world_camera;
    const Pose& b = poses[i].T_world_camera;
    const double way = (a.translation() - b.translation()).norm() / time_s;
    const double angle = angle_between(a, b) / time_s;
    if (way <= kFast_m_s && angle <= kFast_rad_s) continue;
    if (fast++ == 0) first_s = poses[i].time_s;
    speed = std::max(speed, way);
    turn = std::max(turn, angle);
  }
  if (static_cast<double>(fast) <= kMaxShare * static_cast<double>(poses.size())) return;
  char text[300];
  std::snprintf(text, sizeof text,
                ": in %zu of %zu steps the camera moves as none does (up to %.3g m/s and %.3g "
                "rad/s; first at %.6f s): are time stamps in seconds and positions in metres? "
                "Taken: ",
                fast, poses.size() - 1, speed, turn, first_s);
  source.notices.push_back(source.file.string() + text + source.taken);
}

}  // namespace canopeer
