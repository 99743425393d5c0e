#include "map_world.h"

#include "canopeer/map/fusion.h"

namespace canopeer {

const std::vector<BallScene::View>& views() {
  static const std::vector<BallScene::View> all = [] {
    BallScene scene = BallScene::random(1, 300);
    scene.wall_x = 2.5;
    Rng rng(1, "bench cameras");
    std::vector<BallScene::View> rendered;
    for (int i = 0; i < kViews; ++i) {
      rendered.push_back(scene.render(BallScene::random_camera(rng), kCamera));
    }
    return rendered;
  }();
  return all;
}

const std::vector<Pose>& view_poses() {
  static const std::vector<Pose> all = [] {
    Rng rng(1, "bench views");
    std::vector<Pose> poses;
    for (int i = 0; i < 100; ++i) poses.push_back(BallScene::random_camera(rng));
    return poses;
  }();
  return all;
}

const VoxelMap& fused_map() {
  static const VoxelMap map = [] {
    VoxelMap fused;
    for (int i = 0; i + 1 < kViews; ++i) fuse(fused, views()[i].frame, views()[i].roi);
    return fused;
  }();
  return map;
}

octomap::point3d point(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

const octomap::OcTree& fused_octree() {
  static const octomap::OcTree tree = [] {
    octomap::OcTree copy(kResolution);
    for (const BlockKey key : fused_map().block_keys()) {
      for_each_voxel(key, fused_map().block(key)->observed, [&](const VoxelIndex& v) {
        copy.setNodeValue(point(voxel_centre(v, kResolution)),
                          static_cast<float>(fused_map().occupancy_log_odds(v)), true);
      });
    }
    copy.updateInnerOccupancy();
    return copy;
  }();
  return tree;
}

}  // namespace canopeer
