#pragma once

#include <memory>

#include "canopeer/map/voxel_map.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

// The check a user of FCL writes: the links' shapes against each other and against an octree of the
// same map, bounding boxes first.
class FclWorld {
 public:
  FclWorld(const RobotModel& robot, const TrolleyState& trolley, const VoxelMap& map);
  ~FclWorld();
  [[nodiscard]] bool state_free(const Configuration& q) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
