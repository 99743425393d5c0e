#pragma once

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// The robot the project ships.
inline const RobotModel& shipped_robot() {
  static const Expected<RobotModel> robot =
      load_robot(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml");
  if (!robot) ADD_FAILURE() << robot.error().message;
  return *robot;
}

inline Configuration random_configuration(Rng& random, const RobotModel& robot) {
  Configuration q(robot.dof());
  for (int i = 0; i < robot.dof(); ++i)
    q[i] = random.uniform(robot.span().lower[i], robot.span().upper[i]);
  return q;
}

/// Small leaves of occupied voxels at random around an arm at this trolley state.
inline VoxelMap random_leaves(Rng& random, const RobotModel& robot, const TrolleyState& trolley,
                              int count) {
  VoxelMap map;
  const Pose T_world_base = robot.T_world_base(trolley);
  for (int leaf = 0; leaf < count; ++leaf) {
    const Vec3 centre = T_world_base * Vec3{random.uniform(-0.9, 0.9), random.uniform(0.3, 0.9),
                                            random.uniform(-0.2, 1.0)};
    const Vec3 normal = Vec3{random.normal(), random.normal(), random.normal()}.normalized();
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    for (double a = -0.04; a <= 0.04; a += 0.005) {
      for (double b = -0.02; b <= 0.02; b += 0.005)
        map.set_occupancy_log_odds(voxel_at(centre + a * u + b * v, map.resolution_m()), 2.0);
    }
  }
  return map;
}

inline DistanceField field_around(const VoxelMap& map, const RobotModel& robot,
                                  const TrolleyState& trolley) {
  DistanceFieldOptions options;
  const Vec3 reach = Vec3::Constant(1.5);
  const Vec3 base = robot.T_world_base(trolley).translation();
  options.world = Box(base - reach, base + reach);
  DistanceField field(options, map.resolution_m());
  field.rebuild(map);
  return field;
}

}  // namespace canopeer
