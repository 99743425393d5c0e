#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "canopeer/planner/vmp/vmp_planner.h"
#include "planner_fixture.h"

// Faults put between planner and simulation through the ports: what [Zaenker23] does about them,
// section III-E.

namespace canopeer {
namespace {

/// An arm that stops beside its goal when told to.
class StragglingArm : public Arm {
 public:
  explicit StragglingArm(Arm& arm) : arm_(arm) {}
  void miss_next_by(double rad) { miss_rad_ = rad; }

  Configuration configuration() const override { return arm_.configuration(); }
  Expected<double> start(const JointPath& path) override {
    JointPath elsewhere = path;
    elsewhere.waypoints.back()[0] += std::exchange(miss_rad_, 0.0);
    return arm_.start(elsewhere);
  }
  Expected<MotionOutcome> finish() override { return arm_.finish(); }

 private:
  Arm& arm_;
  double miss_rad_ = 0.0;
};

/// A camera that reports a ball where there is none: frames of it alone, as if taken from half a
/// metre aside.
class BallCamera : public Camera {
 public:
  explicit BallCamera(Camera& camera) : camera_(camera) {}
  void hang_ball(const Vec3& centre_world, double radius_m) {
    centre_ = centre_world;
    radius_m_ = radius_m;
  }

  Expected<RgbdFrame> capture() override {
    auto frame = camera_.capture();
    if (!frame || !centre_) return frame;
    frame->T_world_camera = look_at(*centre_ - 0.5 * Vec3::UnitY(), *centre_);
    for (int v = 0; v < frame->depth.height(); ++v) {
      for (int u = 0; u < frame->depth.width(); ++u) {
        frame->depth.at(u, v) = static_cast<float>(depth_of_ball(frame->intrinsics.ray(u, v)));
        frame->color.at(u, v) = {40, 120, 40};
      }
    }
    return frame;
  }

 private:
  /// Along a ray of depth 1 through a pixel; 0: the ball is not there.
  [[nodiscard]] double depth_of_ball(const Vec3& ray) const {
    const Vec3 centre(0.0, 0.0, 0.5);
    const double b = ray.dot(centre) / ray.squaredNorm();
    const double gap = b * b - (centre.squaredNorm() - radius_m_ * radius_m_) / ray.squaredNorm();
    return gap < 0.0 ? 0.0 : b - std::sqrt(gap);
  }

  Camera& camera_;
  std::optional<Vec3> centre_;
  double radius_m_ = 0.0;
};

class FaultsTest : public ::testing::Test {
 protected:
  FaultsTest()
      : run_(std::make_unique<VmpPlanner>(long_paths())),
        arm_(*run_.ports.arm),
        camera_(*run_.ports.camera) {
    run_.ports.arm = &arm_;
    run_.ports.camera = &camera_;
    run_.planner->grow(0.2, run_.work);
  }

  /// What is tested is how paths are executed, so they should be long.
  static VmpOptions long_paths() {
    VmpOptions options;
    options.search = VmpOptions::Search::random_walk;
    options.random_walk_views = 8;
    options.look_ahead_rad = 100.0;
    return options;
  }
  [[nodiscard]] const VmpPlanner& vmp() const {
    return dynamic_cast<const VmpPlanner&>(*run_.planner);
  }
  /// Where the camera goes next, in the frame of the camera as it is.
  [[nodiscard]] std::optional<Vec3> next_camera() const {
    if (vmp().path().empty()) return std::nullopt;
    const Pose T_world_camera =
        run_.world.frame.T_world_base * run_.world.robot.T_base_camera(run_.q);
    return T_world_camera.inverse() *
           vmp().graph().node(vmp().path().front()).view.T_world_camera.translation();
  }
  /// Takes views until the next one is well away and not behind; false: that never happened.
  bool go_on_until_next_is_far() {
    for (int i = 0; i < 40; ++i) {
      if (!run_.take_view()) return false;
      run_.planner->grow(0.05, run_.work);
      const auto next = next_camera();
      if (next && next->norm() > 0.15 && next->z() > -0.01) return true;
    }
    return false;
  }

  test::PlannerFixture run_;
  StragglingArm arm_;
  BallCamera camera_;
};

TEST_F(FaultsTest, AnArmThatStopsBesideItsGoalGetsANodeThereAndGoesOn) {
  ASSERT_TRUE(run_.take_view());
  const int before = run_.planner->status().off_pose_nodes;
  arm_.miss_next_by(0.03);
  ASSERT_TRUE(run_.take_view());
  const Configuration off = run_.q;
  EXPECT_GT(joint_distance(off, run_.last.motion.waypoints.back()), 0.029);
  ASSERT_TRUE(run_.take_view());
  EXPECT_EQ(run_.planner->status().off_pose_nodes, before + 1);
  EXPECT_EQ(run_.last.motion.waypoints.front(), off);
  EXPECT_TRUE(run_.world.checker.edge_free(off, run_.last.motion.waypoints.back()));
}

TEST_F(FaultsTest, SomethingThatTurnsUpOnTheWayTakesTheEdgeOutAndThePathIsPlannedAnew) {
  ASSERT_TRUE(go_on_until_next_is_far());
  const NodeId next = vmp().path().front();
  const ViewPose blocked = vmp().graph().node(next).view;
  const PlannerStatus before = run_.planner->status();
  camera_.hang_ball(blocked.T_world_camera.translation(), 0.03);
  for (int i = 0; i < 8; ++i) run_.look();  // what was seen free takes a few frames to be occupied
  ASSERT_FALSE(run_.world.checker.edge_free(run_.q, blocked.q));
  ASSERT_TRUE(run_.take_view());
  const PlannerStatus after = run_.planner->status();
  EXPECT_GT(after.blocked_edges, before.blocked_edges);
  EXPECT_GT(after.searches, before.searches);
  EXPECT_GT(joint_distance(run_.last.motion.waypoints.back(), blocked.q), 1e-6);
}

TEST_F(FaultsTest, OffThePoseAndNoWayBackThePathIsPlannedFromWhereTheArmIs) {
  ASSERT_TRUE(go_on_until_next_is_far());
  const ViewPose blocked = vmp().graph().node(vmp().path().front()).view;
  const PlannerStatus before = run_.planner->status();
  // The arm creeps away by itself, and something is in the way back to the path.
  Configuration away = run_.q;
  away[0] += 0.02;
  ASSERT_TRUE(run_.ports.arm->start({{run_.q, away}}).has_value());
  ASSERT_TRUE(run_.ports.arm->finish().has_value());
  run_.q = run_.ports.arm->configuration();
  camera_.hang_ball(blocked.T_world_camera.translation(), 0.03);
  for (int i = 0; i < 8; ++i) run_.look();
  ASSERT_TRUE(run_.take_view());
  const PlannerStatus after = run_.planner->status();
  EXPECT_EQ(after.off_pose_nodes, before.off_pose_nodes + 1);
  EXPECT_GT(after.searches, before.searches);
  EXPECT_EQ(run_.last.motion.waypoints.front(), away);
  EXPECT_GT(joint_distance(run_.last.motion.waypoints.back(), blocked.q), 1e-6);
}

}  // namespace
}  // namespace canopeer
