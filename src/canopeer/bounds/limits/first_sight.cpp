#include "canopeer/bounds/limits/first_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "canopeer/bounds/limits/motion_bound.h"
#include "canopeer/bounds/limits/sight_cell.h"

namespace canopeer {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::infinity();
constexpr double kBesideM = 0.01;  // for depth noise, arrival errors of the arm, rounding
constexpr double kDriveStepM = 0.02;
constexpr double kTimeStep = 0.25;  // s
constexpr double kSteps = 12.0;     // s: what takes longer is looked through at once
constexpr double kAnywhere = 1e5;   // s: an arm that reaches a place reaches it by then

/// Counted fruits, in the order of their ids.
std::vector<FruitBall> counted_balls(const Scene& scene) {
  std::vector<FruitBall> balls(scene.fruits.size());
  for (std::size_t i = 0; i < balls.size(); ++i) balls[i].centre = scene.fruits[i].centre;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* instance) {
    if (part.fruit < 0) return;
    const int first = instance != nullptr ? instance->first_fruit : 0;
    FruitBall& ball = balls[static_cast<std::size_t>(first + part.fruit)];
    for (const Eigen::Vector3f& vertex : part.mesh.vertices) {
      ball.radius_m =
          std::max(ball.radius_m, (T * vertex.cast<double>() - ball.centre).norm() + kBesideM);
    }
  });
  std::vector<FruitBall> counted;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (scene.fruits[i].counted) counted.push_back(balls[i]);
  }
  return counted;
}

/// Boxes of joint angles around one home state, the quickest first.
class SightSearch {
 public:
  SightSearch(const RobotModel& robot, const Frustum& frustum, const Configuration& home,
              const MotionBound& motion)
      : robot_(robot), frustum_(frustum), home_(home), motion_(motion) {}

  /// After so much time at the earliest, s; infinite: not within `time_s`. Ball in the base frame.
  [[nodiscard]] double earliest_s(const FruitBall& ball, double time_s, int cells) const {
    const Configuration still = Configuration::Zero(home_.size());
    if (frustum_.may_hold(ball, camera_cell(robot_, {home_, still}))) return 0.0;
    // Small boxes first: what a short time allows is soon looked through.
    for (double part_s = kTimeStep;; part_s += kTimeStep) {
      const bool all = part_s >= std::min(time_s, kSteps);
      const double found_s = search(ball, all ? time_s : part_s, cells);
      if (std::isfinite(found_s)) return std::max(found_s, part_s - kTimeStep);
      if (all) return kUnseen;
    }
  }

 private:
  struct Open {
    double time_s = 0.0;
    int number = 0;
    JointBox box;
    bool operator<(const Open& other) const {  // the top of a queue is the largest
      return time_s != other.time_s ? time_s > other.time_s : number > other.number;
    }
  };

  [[nodiscard]] double time_to(const JointBox& box) const {
    const Configuration outside =
        ((box.centre - home_).cwiseAbs() - box.half).cwiseMax(Configuration::Zero(home_.size()));
    return motion_.first(outside);
  }

  /// What can be reached in time, within the limits.
  [[nodiscard]] JointBox reachable(double time_s) const {
    JointBox box{home_, home_};
    for (int i = 0; i < home_.size(); ++i) {
      double turn = motion_.most_turn(i, time_s);
      if (robot_.endless()[i]) turn = std::min(turn, std::numbers::pi);  // each place once
      const double low = std::max(home_[i] - turn, robot_.limits().lower[i]);
      const double high = std::min(home_[i] + turn, robot_.limits().upper[i]);
      box.centre[i] = (low + high) / 2.0;
      box.half[i] = std::max(0.0, (high - low) / 2.0) + 1e-9;
    }
    return box;
  }

  [[nodiscard]] double search(const FruitBall& ball, double time_s, int cells) const {
    std::priority_queue<Open> open;
    int number = 0;
    const auto add = [&](const JointBox& box) {
      const double box_s = time_to(box);
      if (box_s <= time_s && frustum_.may_hold(ball, camera_cell(robot_, box))) {
        open.push({box_s, number, box});
      }
      ++number;
    };
    add(reachable(time_s));
    while (!open.empty() && number < cells) {
      const JointBox box = open.top().box;
      open.pop();
      const int joint = widest(ball, box);
      JointBox half = box;
      half.half[joint] /= 2.0;
      half.centre[joint] = box.centre[joint] - half.half[joint];
      add(half);
      half.centre[joint] = box.centre[joint] + half.half[joint];
      add(half);
    }
    return open.empty() ? kUnseen : open.top().time_s;
  }

  /// The joint that makes its camera most uncertain.
  [[nodiscard]] int widest(const FruitBall& ball, const JointBox& box) const {
    Configuration arms;
    const CameraCell cell = camera_cell(robot_, box, &arms);
    const double distance_m = std::max(0.2, (ball.centre - cell.T.translation()).norm());
    int joint = 0;
    double most = -1.0;
    for (int i = 0; i < arms.size(); ++i) {
      const bool turns = robot_.arm_joint_type(i) == JointType::kRevolute;
      const double width = box.half[i] * (arms[i] / distance_m + (turns ? 1.0 : 0.0));
      if (width <= most) continue;
      most = width;
      joint = i;
    }
    return joint;
  }

  const RobotModel& robot_;
  const Frustum& frustum_;
  Configuration home_;
  const MotionBound& motion_;
};

FruitBall seen_from(const Pose& T_world_base, const FruitBall& ball) {
  return {T_world_base.inverse() * ball.centre, ball.radius_m};
}

/// Whether the parked camera may see the ball somewhere on a drive: along the row, then the lift.
bool seen_on_drive(const RobotModel& robot, const Frustum& frustum, const Configuration& home,
                   const TrolleyState& from, const TrolleyState& to, const FruitBall& ball) {
  const Pose T_base_camera = robot.T_base_camera(home);
  const auto seen_along = [&](const TrolleyState& a, const TrolleyState& b) {
    const double way_m = std::abs(b.travel_m - a.travel_m) + std::abs(b.lift_m - a.lift_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(way_m / kDriveStepM)));
    for (int i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      const TrolleyState at{a.travel_m + part * (b.travel_m - a.travel_m),
                            a.lift_m + part * (b.lift_m - a.lift_m)};
      const CameraCell cell{robot.T_world_base(at) * T_base_camera, way_m / steps / 2.0, 0.0};
      if (frustum.may_hold(ball, cell)) return true;
    }
    return false;
  };
  const TrolleyState corner{to.travel_m, from.lift_m};
  return seen_along(from, corner) || seen_along(corner, to);
}

}  // namespace

std::vector<double> first_sights_s(const Scene& scene, const RobotModel& robot,
                                   const MissionOptions& mission, const CameraIntrinsics& camera,
                                   const SegmentTimes& times, int cells) {
  const double max_depth_m = std::min(camera.max_range_m, mission.fruit.tsdf.max_range_m) + 0.05;
  const Frustum frustum(camera, max_depth_m);
  const bool on_the_way = mission.on_the_way.hz > 0.0;
  const MotionBound motion(robot, on_the_way);
  const double reach_m = camera_reach_m(robot) + frustum.farthest_m();
  const std::vector<FruitBall> balls = counted_balls(scene);
  std::vector<double> seen_s(balls.size(), kUnseen);
  for (std::size_t s = 0; s < times.count(); ++s) {
    const SegmentPlan& segment = mission.segments[s];
    const Pose T_world_base = robot.T_world_base(segment.trolley);
    const Configuration home = segment_home(robot, segment);
    const SightSearch search(robot, frustum, home, motion);
    const double start_s = times.earliest_s[s];
    const double drive_s = s > 0 ? times.earliest_leave_s(s - 1) : kUnseen;
    for (std::size_t f = 0; f < balls.size(); ++f) {
      if (on_the_way && s > 0 && drive_s < seen_s[f] &&
          seen_on_drive(robot, frustum, home, mission.segments[s - 1].trolley, segment.trolley,
                        balls[f])) {
        seen_s[f] = drive_s;
      }
      const FruitBall ball = seen_from(T_world_base, balls[f]);
      if (start_s >= seen_s[f] || ball.centre.norm() > reach_m + ball.radius_m) continue;
      if (robot.has_followers()) {  // boxes of joints say nothing of them
        seen_s[f] = start_s;
        continue;
      }
      const double left_s =
          std::clamp(std::min(times.end_s, seen_s[f]) - start_s - times.look_s, 0.0, kAnywhere);
      const double after_s = search.earliest_s(ball, left_s, cells);
      seen_s[f] = std::min(seen_s[f], start_s + (after_s > 0.0 ? times.look_s : 0.0) + after_s);
    }
  }
  return seen_s;
}

}  // namespace canopeer
