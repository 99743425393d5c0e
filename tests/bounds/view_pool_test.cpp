#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/bounds/view_pool_builder.h"
#include "canopeer/bounds/view_pool_file.h"
#include "canopeer/bounds/visibility_ceiling.h"
#include "canopeer/bounds/world_hash.h"
#include "canopeer/geometry/state_archive.h"
#include "canopeer/scene/worlds.h"
#include "support/must.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Two segments of Scenario 1, few views.
struct SmallMission {
  SmallMission() : scene(make_world(scenario_1_world(), 1)), judge(robot, scene) {
    mission.segments = {{{1.0, 0.0}, 1, "one"}, {{1.0, 0.0}, 2, "two"}};
    options.batch = 60;
    options.most = 240;
    options.aimed = 2;
    options.image_width = 80;
    options.again = 1;
  }

  [[nodiscard]] Expected<ViewPool> build(const PoolCallbacks& callbacks = {}) const {
    return build_view_pool(robot, ik, scene, judge, mission, camera, options, callbacks);
  }

  const RobotModel& robot = test::test_robot();
  ArmIk ik = must(ArmIk::make(robot));
  Scene scene;
  MotionJudge judge;
  MissionOptions mission;
  CameraIntrinsics camera;
  PoolOptions options;
};

SmallMission& small() {
  static SmallMission mission;
  return mission;
}

const ViewPool& whole_pool() {
  static const ViewPool pool = must(small().build());
  return pool;
}

fs::path fresh_file(const std::string& name) {
  const fs::path path = fs::path(testing::TempDir()) / ("canopeer_" + name);
  fs::remove(path);
  return path;
}

TEST(ViewPool, HasHomeFirstAndViewsThatTouchNothing) {
  const ViewPool& pool = whole_pool();
  ASSERT_EQ(pool.segments.size(), 2U);
  EXPECT_GT(pool.sampled, 300);
  for (int s = 0; s < 2; ++s) {
    const auto& views = pool.segments[static_cast<std::size_t>(s)];
    ASSERT_GT(views.size(), 20U);
    EXPECT_EQ(views.front().q, small().robot.home("side_" + std::to_string(s + 1)));
    for (std::size_t i = 0; i < views.size(); ++i) {
      const PoolView& view = views[i];
      EXPECT_TRUE(small().robot.within_limits(view.q));
      const Verdict verdict =
          small().judge.judge({view.q}, small().mission.segments[0].trolley, nullptr);
      EXPECT_FALSE(verdict.collision || verdict.plant_contact);
      EXPECT_TRUE(i == 0 || !view.patches.empty());
      const Pose T = small().robot.T_world_base(small().mission.segments[0].trolley) *
                     small().robot.T_base_camera(view.q);
      EXPECT_TRUE(T.isApprox(view.T_world_camera));
    }
  }
}

TEST(ViewPool, ThinningKeepsEverythingThatASampleShowed) {
  const ViewPool& pool = whole_pool();
  std::vector<char> seen(pool.patches.fruit.size(), 0);
  for (const auto& views : pool.segments) {
    for (const PoolView& view : views) {
      for (const std::uint32_t p : view.patches) seen[p] = 1;
    }
  }
  for (std::size_t p = 0; p < seen.size(); ++p) {
    EXPECT_EQ(seen[p] != 0, pool.times_seen[p] > 0) << p;
  }
  const Ceiling ceiling = ceiling_of(pool, {2.0});
  EXPECT_GT(ceiling.fruits, 0);
  EXPECT_LE(ceiling.fruits, ceiling.fruits_seen);
  EXPECT_LE(ceiling.fruits_seen, small().scene.counted_fruits());
  EXPECT_GT(ceiling.surface, 0.0);
  EXPECT_LT(ceiling.surface, 1.0);
  EXPECT_EQ(ceiling.views, pool.sampled);
}

TEST(ViewPool, AimsAgainAtWhatFewViewsHaveShown) {
  SmallMission less;
  less.options.again = 0;
  const ViewPool pool = must(less.build());
  const auto seen = [](const ViewPool& p, auto often) {
    return std::count_if(p.times_seen.begin(), p.times_seen.end(), often);
  };
  const auto ever = [](std::uint32_t n) { return n > 0; };
  const auto once = [](std::uint32_t n) { return n == 1; };
  EXPECT_GT(seen(whole_pool(), ever), seen(pool, ever));
  EXPECT_LT(seen(whole_pool(), once), seen(pool, once));
  EXPECT_GT(whole_pool().sampled, pool.sampled);
  // What the first rounds showed is still there.
  for (std::size_t p = 0; p < pool.times_seen.size(); ++p) {
    EXPECT_LE(pool.times_seen[p], whole_pool().times_seen[p]) << p;
  }
}

TEST(ViewPool, IsTheSameWithAnyNumberOfThreads) {
  using Control = oneapi::tbb::global_control;
  const Control one(Control::max_allowed_parallelism, 1);
  const ViewPool pool = must(small().build());
  EXPECT_EQ(state_bytes(pool), state_bytes(whole_pool()));
}

TEST(ViewPool, GoesOnAfterStopsAsIfThereHadBeenNone) {
  SmallMission stopped;
  stopped.options.checkpoint = fresh_file("views.part");
  int stops = 0;
  for (;; ++stops) {
    const auto pool = stopped.build({{}, [] { return true; }});
    if (pool) {
      EXPECT_EQ(state_bytes(*pool), state_bytes(whole_pool()));
      break;
    }
    EXPECT_TRUE(fs::exists(stopped.options.checkpoint));
    ASSERT_LT(stops, 20);
  }
  EXPECT_GT(stops, 2);
  EXPECT_FALSE(fs::exists(stopped.options.checkpoint));
}

TEST(ViewPool, BeginsAnewWhereTheCheckpointIsOfAnotherPool) {
  SmallMission other;
  other.options.checkpoint = fresh_file("views_other.part");
  other.options.most = 120;
  ASSERT_FALSE(other.build({{}, [] { return true; }}));
  other.options.most = 240;
  EXPECT_EQ(state_bytes(must(other.build())), state_bytes(whole_pool()));
  ASSERT_TRUE(write_file(other.options.checkpoint, "no checkpoint"));
  EXPECT_EQ(state_bytes(must(other.build())), state_bytes(whole_pool()));
}

TEST(ViewPool, RefusesOptionsThatCannotBe) {
  SmallMission wrong;
  wrong.options.batch = 0;
  EXPECT_FALSE(wrong.build());
  wrong.options = {};
  wrong.options.patch_m = 0.0;
  EXPECT_FALSE(wrong.build());
}

TEST(ViewPoolFile, GivesBackThePoolAndRefusesDamage) {
  const fs::path path = fresh_file("views.pool");
  ASSERT_TRUE(write_view_pool(path, whole_pool()));
  EXPECT_EQ(state_bytes(must(read_view_pool(path))), state_bytes(whole_pool()));
  std::string bytes = must(read_file(path));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  ASSERT_TRUE(write_file(path, bytes));
  const auto damaged = read_view_pool(path);
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().message.find("views.pool"), std::string::npos);
  ASSERT_TRUE(write_file(path, "something else"));
  EXPECT_FALSE(read_view_pool(path));
  EXPECT_FALSE(read_view_pool(fresh_file("none.pool")));
}

TEST(WorldHash, TellsWorldsRobotsAndCamerasApart) {
  const std::vector<std::string> robot = {"a", "b"};
  const std::vector<std::string> other = {"ab", ""};
  const CameraIntrinsics camera;
  CameraIntrinsics near = camera;
  near.max_range_m = 2.0;
  const Scene second = make_world(scenario_1_world(), 2);
  const auto hash = world_hash(small().scene, robot, camera);
  EXPECT_EQ(hash, world_hash(make_world(scenario_1_world(), 1), robot, camera));
  EXPECT_NE(hash, world_hash(small().scene, other, camera));
  EXPECT_NE(hash, world_hash(small().scene, robot, near));
  EXPECT_NE(hash, world_hash(second, robot, camera));
  EXPECT_EQ(hash_text(0x1fU), "000000000000001f");
}

}  // namespace
}  // namespace canopeer
