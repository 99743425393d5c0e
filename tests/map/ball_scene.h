#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/map/fusion.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// Balls in front of a wall at x = wall_x, some of them fruit: enough of a row of plants for the
/// map's tests and benchmarks, and rendered exactly.
struct BallScene {
  struct Ball {
    Vec3 centre;
    double radius;
    bool fruit;
  };
  std::vector<Ball> balls;
  double wall_x = 1.2345;

  /// `count` balls in x 0.6 … 1.1, y −1 … 1, z −0.6 … 0.6, one in ten a fruit.
  static BallScene random(std::uint64_t seed, int count) {
    Rng rng(seed, "ball scene");
    BallScene scene;
    for (int i = 0; i < count; ++i) {
      const Vec3 centre{rng.uniform(0.6, 1.1), rng.uniform(-1.0, 1.0), rng.uniform(-0.6, 0.6)};
      scene.balls.push_back({centre, rng.uniform(0.02, 0.06), i % 10 == 0});
    }
    return scene;
  }

  struct View {
    RgbdFrame frame;
    Mask roi;
  };

  [[nodiscard]] View render(const Pose& T_world_camera, const CameraIntrinsics& k) const {
    View view;
    view.frame.intrinsics = k;
    view.frame.T_world_camera = T_world_camera;
    view.frame.depth = DepthImage(k.width, k.height);
    view.roi = Mask(k.width, k.height);
    const Vec3 origin = T_world_camera.translation();
    for (int v = 0; v < k.height; ++v) {
      for (int u = 0; u < k.width; ++u) {
        const Vec3 direction = T_world_camera.linear() * k.ray(u, v);
        double nearest = direction.x() > 0.0 ? (wall_x - origin.x()) / direction.x()
                                             : std::numeric_limits<double>::infinity();
        for (const Ball& ball : balls) {
          const Vec3 to_ball = ball.centre - origin;
          const double a = direction.squaredNorm();
          const double b = direction.dot(to_ball);
          const double c = to_ball.squaredNorm() - ball.radius * ball.radius;
          const double root2 = b * b - a * c;
          if (root2 < 0.0) continue;
          const double t = (b - std::sqrt(root2)) / a;
          if (t <= 0.0 || t >= nearest) continue;
          nearest = t;
          view.roi.at(u, v) = ball.fruit ? 1 : 0;
        }
        view.frame.depth.at(u, v) = static_cast<float>(nearest);
      }
    }
    return view;
  }

  /// A camera in the aisle, somewhere around (−0.2, 0, 0), that looks at the row.
  static Pose random_camera(Rng& rng) {
    const Vec3 position{rng.uniform(-0.3, 0.1), rng.uniform(-0.6, 0.6), rng.uniform(-0.4, 0.4)};
    const Vec3 target{0.85, rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.3)};
    return look_at(position, target, rng.uniform(-0.5, 0.5));
  }

  /// The map after `views` frames of a small camera.
  static VoxelMap map(std::uint64_t seed, int views, double resolution_m = 0.02) {
    const BallScene scene = random(seed, 60);
    VoxelMapOptions options;
    options.resolution_m = resolution_m;
    VoxelMap map(options);
    Rng rng(seed, "cameras");
    for (int i = 0; i < views; ++i) {
      const View view =
          scene.render(random_camera(rng), CameraIntrinsics::from_fov(160, 120, 1.396));
      fuse(map, view.frame, view.roi);
    }
    return map;
  }
};

/// A map with exactly these voxels, for hand-made cases.
inline VoxelMap map_of(const std::vector<VoxelIndex>& free, const std::vector<VoxelIndex>& occupied,
                       const std::vector<VoxelIndex>& roi = {}) {
  VoxelMap map;
  for (const VoxelIndex& voxel : free) map.set_occupancy_log_odds(voxel, -1.0);
  for (const VoxelIndex& voxel : occupied) map.set_occupancy_log_odds(voxel, 1.0);
  for (const VoxelIndex& voxel : roi) map.set_roi_log_odds(voxel, 1.0);
  return map;
}

}  // namespace canopeer
