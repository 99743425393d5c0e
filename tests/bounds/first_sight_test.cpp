#include "canopeer/bounds/limits/first_sight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/base/rng.h"
#include "canopeer/bounds/limits/motion_bound.h"
#include "canopeer/bounds/limits/sight_cell.h"
#include "canopeer/bounds/upper_bounds.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/mission/mission_time.h"
#include "canopeer/scene/worlds.h"
#include "support/must.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

using test::test_robot;

const RobotModel& rail_robot() {
  static const RobotModel kRobot =
      must(load_robot(CANOPEER_SOURCE_DIR "/robots/panda_rail/robot.yaml"));
  return kRobot;
}

Configuration random_within(const JointBox& box, Rng& rng) {
  Configuration q = box.centre;
  for (int i = 0; i < q.size(); ++i) q[i] += box.half[i] * rng.uniform(-1.0, 1.0);
  return q;
}

JointBox random_box(const RobotModel& robot, double most, Rng& rng) {
  JointBox box{robot.home("side_1"), robot.home("side_1")};
  for (int i = 0; i < box.half.size(); ++i) {
    box.centre[i] += rng.normal(0.0, 1.0);
    box.half[i] = rng.uniform(0.0, most);
  }
  return box;
}

TEST(CameraCell, HoldsTheCamerasOfAllItsConfigurations) {
  for (const RobotModel* robot : {&test_robot(), &rail_robot()}) {
    Rng rng(1, "boxes");
    for (int i = 0; i < 3000; ++i) {
      const JointBox box = random_box(*robot, i % 2 == 0 ? 0.1 : 1.0, rng);
      const CameraCell cell = camera_cell(*robot, box);
      const Configuration q = random_within(box, rng);
      const Pose T = robot->T_base_camera(q);
      EXPECT_LE((T.translation() - cell.T.translation()).norm(), cell.shift_m + 1e-9);
      const Eigen::AngleAxisd turn(Eigen::Matrix3d((cell.T.inverse() * T).linear()));
      EXPECT_LE(std::abs(turn.angle()), cell.turn_rad + 1e-7);
      if (!robot->within_limits(q)) continue;
      EXPECT_LE(T.translation().norm(), camera_reach_m(*robot) + 1e-9);
    }
  }
}

bool shows(const CameraIntrinsics& camera, const Pose& T, const Vec3& point, double max_depth_m) {
  const Vec3 p = T.inverse() * point;
  const double u = camera.fx * p.x() / p.z() + camera.cx;
  const double v = camera.fy * p.y() / p.z() + camera.cy;
  return p.z() >= camera.min_range_m && p.z() <= max_depth_m && u >= 0.0 && u < camera.width &&
         v >= 0.0 && v < camera.height;
}

TEST(Frustum, LosesNoPointThatACameraOfTheCellShows) {
  Rng rng(2, "points");
  const CameraIntrinsics camera = CameraIntrinsics::from_fov(640, 480, 1.4);
  const Frustum frustum(camera, 1.6);
  int shown = 0;
  int dropped = 0;
  for (int i = 0; i < 20000; ++i) {
    const JointBox box = random_box(test_robot(), i % 2 == 0 ? 0.05 : 0.4, rng);
    const CameraCell cell = camera_cell(test_robot(), box);
    const FruitBall ball{cell.T.translation() + Vec3{rng.normal(), rng.normal(), rng.normal()},
                         0.04};
    const Pose T = test_robot().T_base_camera(random_within(box, rng));
    const Vec3 point =
        ball.centre + 0.039 * Vec3{rng.normal(), rng.normal(), rng.normal()}.normalized();
    const bool may = frustum.may_hold(ball, cell);
    dropped += !may;
    if (!shows(camera, T, point, 1.6)) continue;
    ++shown;
    EXPECT_TRUE(may) << i;
  }
  EXPECT_GT(shown, 500);
  EXPECT_GT(dropped, 5000);
}

/// Scenario 1 with a few stops, and configurations around the home states, by chance.
struct Stops {
  Scene scene = make_world(scenario_1_world(), 1);
  MissionOptions mission;
  CameraIntrinsics camera = CameraIntrinsics::from_fov(640, 480, 1.4);

  Stops() {
    mission.segments.resize(4);
    for (std::size_t s = 0; s < 4; ++s) {
      mission.segments[s].side = 1 + static_cast<int>(s % 2);
      mission.segments[s].trolley.travel_m = 1.0 + static_cast<double>(s / 2);
    }
    mission.segment_time_s = 5.0;
    mission.mission_time_s = whole_mission_time_s(test_robot(), mission);
    mission.costs[Work::detect_frame] = 0.01;
  }

  /// Views of a pool that sees through everything; a patch is a fruit's centre.
  [[nodiscard]] ViewPool pool(int views) const {
    ViewPool pool;
    std::vector<Vec3> centres;
    for (const FruitTruth& fruit : scene.fruits) {
      if (!fruit.counted) continue;
      centres.push_back(fruit.centre);
      pool.patches.fruit.push_back(fruit.id);
      pool.patches.area_cm2.push_back(10.0F);
      ++pool.patches.fruits_total;
    }
    Rng rng(3, "views");
    for (const SegmentPlan& plan : mission.segments) {
      pool.segments.emplace_back();
      for (int v = 0; v < views; ++v) {
        PoolView view;
        view.q = segment_home(test_robot(), plan);
        for (int i = 0; v > 0 && i < view.q.size(); ++i) view.q[i] += rng.normal(0.0, 0.5);
        view.q = view.q.cwiseMax(test_robot().limits().lower).cwiseMin(test_robot().limits().upper);
        view.T_world_camera =
            test_robot().T_world_base(plan.trolley) * test_robot().T_base_camera(view.q);
        for (std::uint32_t p = 0; p < centres.size(); ++p) {
          if (shows(camera, view.T_world_camera, centres[p], 1.6)) view.patches.push_back(p);
        }
        pool.segments.back().push_back(std::move(view));
      }
    }
    return pool;
  }
};

TEST(FirstSight, NoConfigurationShowsAFruitSooner) {
  Stops stops;
  const ViewPool pool = stops.pool(3000);
  for (const double hz : {0.0, 15.0}) {
    stops.mission.on_the_way.hz = hz;
    const MotionBound motion(test_robot(), hz > 0.0);
    const SegmentTimes times = segment_times(test_robot(), stops.mission, {0.0, 0.0, 0.0, 0.0});
    const std::vector<double> first =
        first_sights_s(stops.scene, test_robot(), stops.mission, stops.camera, times, 300);
    ASSERT_EQ(first.size(), pool.patches.fruit.size());
    int later_than_home = 0;
    for (const double t_s : first) later_than_home += t_s > 0.1;
    EXPECT_GT(later_than_home, 0);
    for (std::size_t s = 0; s < pool.segments.size(); ++s) {
      for (const PoolView& view : pool.segments[s]) {
        const double there_s = motion.first(pool.segments[s][0].q, view.q);
        const double t_s = times.earliest_s[s] + there_s + (there_s > 0.0 ? times.look_s : 0.0);
        if (t_s > times.end_s) continue;
        for (const std::uint32_t p : view.patches) EXPECT_LE(first[p], t_s + 1e-9);
      }
    }
  }
}

TEST(CertifiedBound, IsNowhereBelowTheSampledOne) {
  Stops stops;
  const ViewPool pool = stops.pool(300);
  for (const bool whole : {true, false}) {
    if (!whole) stops.mission.mission_time_s = 0.0;
    const UpperBound certified =
        certified_bound(stops.scene, test_robot(), stops.mission, stops.camera);
    const UpperBound sampled = sampled_bound(pool, test_robot(), stops.mission, {0.0});
    EXPECT_GE(*certified.fruits, *sampled.fruits);
    EXPECT_GE(*certified.auc, *sampled.auc);
    for (const FruitsByTime& at : sampled.course) {
      double fruits = 0.0;
      for (const FruitsByTime& c : certified.course) {
        if (c.t_s <= at.t_s) fruits = c.fruits;
      }
      EXPECT_GE(fruits, at.fruits) << "at " << at.t_s << " s";
    }
  }
}

}  // namespace
}  // namespace canopeer
