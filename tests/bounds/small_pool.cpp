#include "small_pool.h"

#include <algorithm>

#include "canopeer/base/rng.h"
#include "canopeer/render/occlusion.h"

namespace canopeer::test {
namespace {

constexpr double kReachM = 1.0;  // of the fruit map

bool in_image(const Vec3& p_camera, const CameraIntrinsics& camera) {
  if (p_camera.z() < camera.min_range_m) return false;
  const double u = camera.fx * p_camera.x() / p_camera.z() + camera.cx;
  const double v = camera.fy * p_camera.y() / p_camera.z() + camera.cy;
  return u > 10 && v > 10 && u < camera.width - 10 && v < camera.height - 10;
}

}  // namespace

ViewPool small_pool(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                    const MotionJudge& judge, const MissionOptions& mission,
                    const CameraIntrinsics& camera, int views) {
  const OcclusionProbe probe(scene);
  ViewPool pool;
  std::vector<FruitTruth> counted;
  std::vector<std::uint32_t> first_patch;
  for (const FruitTruth& fruit : scene.fruits) {
    if (!fruit.counted) continue;
    counted.push_back(fruit);
    first_patch.push_back(static_cast<std::uint32_t>(pool.patches.fruit.size()));
    const std::size_t points = probe.point_count(fruit.id);
    pool.patches.fruit.insert(pool.patches.fruit.end(), points, fruit.id);
    pool.patches.area_cm2.insert(
        pool.patches.area_cm2.end(), points,
        static_cast<float>(fruit.surface_cm2 / static_cast<double>(points)));
    pool.patches.area_total_cm2 += fruit.surface_cm2;
  }
  pool.patches.fruits_total = static_cast<int>(counted.size());
  for (std::size_t s = 0; s < mission.segments.size(); ++s) {
    const SegmentPlan& segment = mission.segments[s];
    const Pose T_world_base = robot.T_world_base(segment.trolley);
    const Pose T_base_world = T_world_base.inverse();
    const auto add = [&](const Configuration& q) {
      PoolView view;
      view.q = q;
      view.T_world_camera = T_world_base * robot.T_base_camera(q);
      const Pose T_camera_world = view.T_world_camera.inverse();
      const Vec3 eye = view.T_world_camera.translation();
      for (std::size_t f = 0; f < counted.size(); ++f) {
        if ((counted[f].centre - eye).norm() > kReachM) continue;
        if (!in_image(T_camera_world * counted[f].centre, camera)) continue;
        for (const std::uint32_t point : probe.view(counted[f].id, eye).points) {
          view.patches.push_back(first_patch[f] + point);
        }
      }
      std::sort(view.patches.begin(), view.patches.end());
      pool.segments[s].push_back(std::move(view));
    };
    pool.segments.emplace_back();
    const Configuration home = robot.home("side_" + std::to_string(segment.side));
    add(home);
    Rng rng(1, "small pool", s);
    const Box& box = robot.workspace(segment.side);
    std::vector<Configuration> solutions;
    for (int tries = 0; tries < 100 * views; ++tries) {
      if (static_cast<int>(pool.segments[s].size()) > views) break;
      Vec3 camera_base;
      for (int i = 0; i < 3; ++i) camera_base[i] = rng.uniform(box.min()[i], box.max()[i]);
      const Vec3 target_base = T_base_world * counted[rng.index(counted.size())].centre;
      const double distance = (target_base - camera_base).norm();
      if (distance > 0.8 || distance < 0.2) continue;
      solutions.clear();
      ik.solve_view(camera_base, target_base, home, solutions);
      for (const Configuration& q : solutions) {
        ++pool.sampled;
        const Verdict verdict = judge.judge({q}, segment.trolley, nullptr);
        if (verdict.collision || verdict.plant_contact) continue;
        add(q);
        break;
      }
    }
  }
  return pool;
}

}  // namespace canopeer::test
