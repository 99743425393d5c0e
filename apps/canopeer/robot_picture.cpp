#include "robot_picture.h"

#include "canopeer/import/shape_mesh.h"
#include "canopeer/robot/collision_checker.h"

namespace canopeer::app {
namespace {

constexpr double kBar = 0.008;   // m, thickness of lines
constexpr double kSight = 0.35;  // m, of the camera's axis

TriangleMesh mesh_of(const CollisionShape& shape) {
  switch (shape.kind) {
    case ShapeKind::kBox:
      return box_mesh(shape.size_m);
    case ShapeKind::kCylinder:
      return cylinder_mesh(shape.size_m.x(), shape.size_m.z());
    case ShapeKind::kSphere:
      return ellipsoid_mesh(shape.size_m);
    case ShapeKind::kMesh: {
      TriangleMesh mesh = shape.mesh->triangles;
      compute_normals(mesh);
      return mesh;
    }
  }
  return {};
}

void add(Scene& scene, const TriangleMesh& mesh, const Pose& T_world_mesh, Rgb color) {
  ScenePart part;
  part.mesh.append(mesh, T_world_mesh);
  part.color = color;
  scene.parts.push_back(std::move(part));
}

/// The twelve edges of a box as bars.
void add_frame(Scene& scene, const Box& box, const Pose& T_world_box, Rgb color) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 size = Vec3::Constant(kBar);
    size[axis] = box.sizes()[axis] + kBar;
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 centre = box.center();
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      centre[u] = (corner & 1) != 0 ? box.max()[u] : box.min()[u];
      centre[v] = (corner & 2) != 0 ? box.max()[v] : box.min()[v];
      add(scene, box_mesh(size), T_world_box * Eigen::Translation3d(centre), color);
    }
  }
}

}  // namespace

Scene robot_scene(const RobotModel& robot, const Configuration& q, int side, bool spheres) {
  constexpr Rgb kTrolley{150, 150, 158};
  constexpr Rgb kArm{70, 120, 190};
  constexpr Rgb kOtherArm{215, 140, 60};
  constexpr Rgb kWorkspace{60, 170, 80};
  constexpr Rgb kRegion{230, 190, 40};
  constexpr Rgb kAxis{205, 40, 50};
  Scene scene;
  scene.name = robot.description().name;
  std::vector<Pose> T_world_link;
  robot.link_poses(q, {}, T_world_link);
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    const Link& link = robot.links()[i];
    const int joints = robot.arm_joints_before(static_cast<int>(i));
    const Rgb color = joints == 0 ? kTrolley : joints % 2 == 0 ? kArm : kOtherArm;
    if (spheres && joints > 0) {
      for (const CollisionShape& shape : link.collision) {
        for (const Sphere& sphere : cover_with_spheres(shape, CollisionOptions().sphere_excess_m))
          add(scene, ellipsoid_mesh(Vec3::Constant(sphere.radius_m)),
              T_world_link[i] * Eigen::Translation3d(sphere.centre), color);
      }
      continue;
    }
    for (const CollisionShape& shape : link.visual.empty() ? link.collision : link.visual)
      add(scene, mesh_of(shape), T_world_link[i] * shape.T_link_shape, color);
  }
  const Pose T_world_camera = robot.T_world_base({}) * robot.T_base_camera(q);
  add(scene, box_mesh(Vec3(kBar, kBar, kSight)),
      T_world_camera * Eigen::Translation3d(0.0, 0.0, kSight / 2.0), kAxis);
  if (side >= 1 && side <= robot.sides()) {
    const Pose T_world_base = robot.T_world_base({});
    add_frame(scene, robot.workspace(side), T_world_base, kWorkspace);
    add_frame(scene, robot.sampling_region(side), T_world_base, kRegion);
  }
  return scene;
}

}  // namespace canopeer::app
