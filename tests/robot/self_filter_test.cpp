#include "canopeer/robot/self_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "canopeer/map/fusion.h"
#include "canopeer/robot/sphere_cover.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Where the ray o + t d (shape frame) enters a solid, by the solids' own equations.
double enters(const CollisionShape& shape, const Vec3& o, const Vec3& d) {
  double in = 0.0, out = kNever;
  const auto clip_slab = [&](int axis, double half) {
    if (d[axis] == 0.0) {
      if (std::abs(o[axis]) > half) out = -1.0;
      return;
    }
    const double a = (-half - o[axis]) / d[axis], b = (half - o[axis]) / d[axis];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  };
  const auto clip_round = [&](double a, double b, double c) {  // a t² + 2 b t + c ≤ 0
    const double root2 = b * b - a * c;
    if (root2 < 0.0) {
      out = -1.0;
      return;
    }
    in = std::max(in, (-b - std::sqrt(root2)) / a);
    out = std::min(out, (-b + std::sqrt(root2)) / a);
  };
  const Vec3 half = shape.half_extents();
  switch (shape.kind) {
    case ShapeKind::kMesh:  // none in the robots seen here
    case ShapeKind::kBox:
      for (int axis = 0; axis < 3; ++axis) clip_slab(axis, half[axis]);
      break;
    case ShapeKind::kCylinder:
      clip_slab(2, half.z());
      clip_round(d.head<2>().squaredNorm(), o.head<2>().dot(d.head<2>()),
                 o.head<2>().squaredNorm() - half.x() * half.x());
      break;
    case ShapeKind::kSphere:
      clip_round(d.squaredNorm(), o.dot(d), o.squaredNorm() - half.x() * half.x());
      break;
  }
  return in <= out ? in : kNever;
}

struct Rendered {
  RgbdFrame frame;
  Mask robot;  // pixels that show it
};

// The robot, and a ball around the camera's view as what is behind it.
Rendered render(const RobotModel& robot, const Configuration& q, const Pose& T_world_camera,
                double behind_m) {
  Rendered image;
  CameraIntrinsics& k = image.frame.intrinsics;
  k = CameraIntrinsics::from_fov(160, 120, 1.396);
  image.frame.T_world_camera = T_world_camera;
  image.frame.depth = DepthImage(k.width, k.height);
  image.robot = Mask(k.width, k.height);
  std::vector<Pose> T_world_link;
  robot.link_poses(q, {}, T_world_link);
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      const Vec3 ray = k.ray(u, v);
      double nearest = kNever;
      for (std::size_t link = 0; link < robot.links().size(); ++link) {
        for (const CollisionShape& shape : robot.links()[link].collision) {
          const Pose T =
              (T_world_camera.inverse() * T_world_link[link] * shape.T_link_shape).inverse();
          nearest = std::min(nearest, enters(shape, T.translation(), T.linear() * ray));
        }
      }
      const double behind = behind_m / ray.norm();
      image.robot.at(u, v) = nearest < behind ? 1 : 0;
      image.frame.depth.at(u, v) = static_cast<float>(std::min(nearest, behind));
    }
  }
  return image;
}

double distance_to_robot(const RobotModel& robot, const std::vector<Pose>& T_world_link,
                         const Vec3& p_world) {
  double nearest = kNever;
  for (std::size_t link = 0; link < robot.links().size(); ++link) {
    for (const CollisionShape& shape : robot.links()[link].collision) {
      const Pose T_shape_world = (T_world_link[link] * shape.T_link_shape).inverse();
      nearest = std::min(nearest, signed_distance(shape, T_shape_world * p_world));
    }
  }
  return nearest;
}

TEST(SelfFilter, TakesOutThePixelsThatShowTheRobotAndNoOthers) {
  const RobotModel& robot = shipped_robot();
  const SelfFilter filter(robot);
  Rng rng(1, "self filter");
  std::int64_t shown = 0, kept = 0;
  for (int i = 0; i < 5; ++i) {
    const Configuration q = random_configuration(rng, robot);
    const Vec3 base = robot.T_world_base({}).translation();
    const Vec3 from =
        base + Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.2, 1)}.normalized() * 1.4;
    const Rendered image = render(robot, q, look_at(from, base + Vec3(0, 0, 0.3)), 3.0);
    RgbdFrame frame = image.frame;
    const std::int64_t masked = filter.mask(frame, q, {});
    std::vector<Pose> T_world_link;
    robot.link_poses(q, {}, T_world_link);
    std::int64_t negative = 0;
    for (int v = 0; v < frame.depth.height(); ++v) {
      for (int u = 0; u < frame.depth.width(); ++u) {
        const float before = image.frame.depth.at(u, v);
        const bool taken_out = frame.depth.at(u, v) < 0.0F;
        negative += taken_out;
        shown += image.robot.at(u, v);
        if (image.robot.at(u, v) != 0) {
          EXPECT_TRUE(taken_out) << "configuration " << i << " pixel " << u << ' ' << v;
          continue;
        }
        const Vec3 p = frame.T_world_camera * (before * frame.intrinsics.ray(u, v));
        const bool near = distance_to_robot(robot, T_world_link, p) <= 0.0101;
        if (near) continue;
        EXPECT_EQ(frame.depth.at(u, v), before) << "configuration " << i;
        ++kept;
      }
    }
    EXPECT_EQ(negative, masked);
  }
  EXPECT_GT(shown, 1000);
  EXPECT_GT(kept, 10000);
}

TEST(SelfFilter, KeepsTheRobotOutOfTheMapAlsoWhereNoReturnMeansFree) {
  const RobotModel& robot = shipped_robot();
  const Configuration q = robot.home("side_1");
  const Vec3 base = robot.T_world_base({}).translation();
  const Pose T_world_camera = look_at(base + Vec3(1.2, 0.3, 0.9), base + Vec3(0, 0, 0.2));
  const Rendered image = render(robot, q, T_world_camera, 2.5);
  FusionOptions options;
  options.clear_no_return = true;
  VoxelMap with_robot, without;
  fuse(with_robot, image.frame, {}, options);
  RgbdFrame frame = image.frame;
  EXPECT_GT(SelfFilter(robot).mask(frame, q, {}), 100);
  fuse(without, frame, {}, options);
  std::vector<Pose> T_world_link;
  robot.link_poses(q, {}, T_world_link);
  const auto occupied_near_robot = [&](const VoxelMap& map) {
    int near = 0;
    map.for_each_occupied(
        Box(base - Vec3::Constant(2), base + Vec3::Constant(2)), [&](const VoxelIndex& v) {
          near += distance_to_robot(robot, T_world_link, voxel_centre(v, 0.01)) < 0.0;
        });
    return near;
  };
  EXPECT_GT(occupied_near_robot(with_robot), 0);
  EXPECT_EQ(occupied_near_robot(without), 0);
  EXPECT_LT(without.observed_voxels(), with_robot.observed_voxels());
}

TEST(SelfFilter, LeavesAFrameAloneThatDoesNotShowTheRobot) {
  const RobotModel& robot = shipped_robot();
  const Vec3 base = robot.T_world_base({}).translation();
  RgbdFrame frame;
  frame.intrinsics = CameraIntrinsics::from_fov(80, 60, 1.2);
  frame.T_world_camera = look_at(base + Vec3(0, 0, 3), base + Vec3(0, 0, 6));
  frame.depth = DepthImage(80, 60, 1.0F);
  const DepthImage before = frame.depth;
  EXPECT_EQ(SelfFilter(robot).mask(frame, robot.home("side_1"), {}), 0);
  EXPECT_EQ(frame.depth.pixels(), before.pixels());
}

}  // namespace
}  // namespace canopeer
