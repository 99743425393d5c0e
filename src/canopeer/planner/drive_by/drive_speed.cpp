#include "canopeer/planner/drive_by/drive_speed.h"

#include <limits>

#include "canopeer/sensing/camera_twist.h"

namespace canopeer {

double drive_speed(const RobotModel& robot, const Configuration& q, const ImageMotionLimit& limit) {
  const Pose T_world_base = robot.T_world_base({0.0, 0.0});
  const Vec3 travel_world =
      robot.T_world_base({1.0, 0.0}).translation() - T_world_base.translation();
  const Pose T_world_camera = T_world_base * robot.T_base_camera(q);
  CameraTwist one_m_s;
  one_m_s.linear = T_world_camera.linear().transpose() * travel_world;
  // The image's speed is proportional to the trolley's.
  const double px_per_m = image_speed(one_m_s, limit.camera, limit.distance_m);
  return px_per_m > 0.0 ? limit.speed_px_s / px_per_m : std::numeric_limits<double>::infinity();
}

}  // namespace canopeer
