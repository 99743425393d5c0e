#include "fcl_world.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <octomap/octomap.h>

namespace canopeer {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const CollisionShape& shape) {
  if (shape.kind == ShapeKind::kBox) return std::make_shared<fcl::Boxd>(shape.size_m);
  if (shape.kind == ShapeKind::kCylinder)
    return std::make_shared<fcl::Cylinderd>(shape.size_m.x(), shape.size_m.z());
  return std::make_shared<fcl::Sphered>(shape.size_m.x());
}

bool touch(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  if (!a.getAABB().overlap(b.getAABB())) return false;
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&a, &b, request, result) > 0;
}

}  // namespace

struct FclWorld::Impl {
  struct Part {
    int link = 0;
    bool moves = false;
    Pose T_link_shape = Pose::Identity();
    std::unique_ptr<fcl::CollisionObjectd> object;
  };
  const RobotModel* robot = nullptr;
  std::vector<Part> parts;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::unique_ptr<fcl::CollisionObjectd> octree;
  std::vector<Pose> T_world_link;
};

FclWorld::FclWorld(const RobotModel& robot, const TrolleyState& trolley, const VoxelMap& map)
    : impl_(std::make_unique<Impl>()) {
  impl_->robot = &robot;
  auto tree = std::make_shared<octomap::OcTree>(map.resolution_m());
  map.for_each_block([&](BlockKey key, const BlockMasks& masks) {
    for_each_voxel(key, masks.observed, [&](const VoxelIndex& voxel) {
      const Eigen::Vector3f p = voxel_centre(voxel, map.resolution_m()).cast<float>();
      tree->setNodeValue(octomap::point3d(p.x(), p.y(), p.z()),
                         masks.occupied.test(voxel) ? 2.0F : -2.0F, true);
    });
  });
  tree->updateInnerOccupancy();
  tree->prune();
  impl_->octree = std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::OcTreed>(tree));
  impl_->octree->computeAABB();

  robot.link_poses(Configuration::Zero(robot.dof()), trolley, impl_->T_world_link);
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    for (const CollisionShape& shape : robot.links()[i].collision) {
      Impl::Part part;
      part.link = static_cast<int>(i);
      part.moves = robot.arm_joints_before(part.link) > 0;
      part.T_link_shape = shape.T_link_shape;
      part.object = std::make_unique<fcl::CollisionObjectd>(
          geometry_of(shape), impl_->T_world_link[i] * shape.T_link_shape);
      part.object->computeAABB();
      impl_->parts.push_back(std::move(part));
    }
  }
  for (std::size_t a = 0; a < impl_->parts.size(); ++a) {
    for (std::size_t b = a + 1; b < impl_->parts.size(); ++b) {
      if (robot.pair_checked(impl_->parts[a].link, impl_->parts[b].link))
        impl_->pairs.emplace_back(a, b);
    }
  }
}

FclWorld::~FclWorld() = default;

bool FclWorld::state_free(const Configuration& q) const {
  impl_->robot->arm_link_poses(q, impl_->T_world_link);
  for (const Impl::Part& part : impl_->parts) {
    if (!part.moves) continue;
    part.object->setTransform(impl_->T_world_link[static_cast<std::size_t>(part.link)] *
                              part.T_link_shape);
    part.object->computeAABB();
  }
  for (const auto& [a, b] : impl_->pairs) {
    if (touch(*impl_->parts[a].object, *impl_->parts[b].object)) return false;
  }
  for (const Impl::Part& part : impl_->parts) {
    if (part.moves && touch(*part.object, *impl_->octree)) return false;
  }
  return true;
}

}  // namespace canopeer
