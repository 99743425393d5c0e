#pragma once

#include <vector>

#include "canopeer/map/distance_field.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// What the arm could run into where its trolley stands, as distances: all triangles of the scene
/// within its reach, and what is mapped there. It tells quickly of most states that they touch
/// nothing.
class NearSpace {
 public:
  /// Both are read here and now, `robot` also later. `edge_m`: of the cells that triangles are made
  /// of.
  NearSpace(const RobotModel& robot, const Scene& scene, const TrolleyState& trolley,
            double edge_m);
  NearSpace(const NearSpace&) = delete;
  NearSpace& operator=(const NearSpace&) = delete;

  /// What is occupied in the map is in the way from now on. What was so far remains: nothing is
  /// taken away. The map's resolution must be edge_m().
  void add(const VoxelMap& map);
  /// The arm at `q` touches neither itself nor the trolley, the scene or the map, for certain.
  /// False says nothing.
  [[nodiscard]] bool surely_free(const Configuration& q) const;

  [[nodiscard]] double edge_m() const { return solid_.resolution_m(); }

 private:
  void mark(std::vector<BlockUpdate> updates);

  Box reach_world_;
  VoxelMap solid_;
  DistanceField field_;
  CollisionChecker checker_;
};

}  // namespace canopeer
