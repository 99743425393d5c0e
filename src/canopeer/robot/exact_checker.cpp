#include "canopeer/robot/exact_checker.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <mutex>

#include "canopeer/map/voxel_map.h"

namespace canopeer {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
using Mesh = fcl::BVHModel<fcl::OBBd>;

std::shared_ptr<Mesh> make_mesh(const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  vertices.reserve(mesh.vertices.size());
  triangles.reserve(mesh.triangles.size());
  for (const auto& v : mesh.vertices) vertices.push_back(v.cast<double>());
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<Mesh>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

Geometry make_geometry(const CollisionShape& shape) {
  switch (shape.kind) {
    case ShapeKind::kBox:
      return std::make_shared<fcl::Boxd>(shape.size_m);
    case ShapeKind::kCylinder:
      return std::make_shared<fcl::Cylinderd>(shape.size_m.x(), shape.size_m.z());
    case ShapeKind::kSphere:
      return std::make_shared<fcl::Sphered>(shape.size_m.x());
    case ShapeKind::kMesh:
      return make_mesh(shape.mesh->triangles);
  }
  return nullptr;
}

bool in_contact(const fcl::CollisionGeometryd* a, const Pose& T_world_a,
                const fcl::CollisionGeometryd* b, const Pose& T_world_b) {
  fcl::CollisionRequestd request;  // yes or no: no contact points
  fcl::CollisionResultd result;
  return fcl::collide(a, T_world_a, b, T_world_b, request, result) > 0;
}

/// A link's shape where it is now.
struct Placed {
  int link = 0;
  const fcl::CollisionGeometryd* geometry = nullptr;
  Pose T_world_shape = Pose::Identity();
  Box bounds;  // world
};

}  // namespace

struct MeshObstacles::Impl {
  /// FCL's tree of the triangles is made when something comes near: most parts never need it.
  class Part {
   public:
    explicit Part(const TriangleMesh& mesh) : triangles_(mesh), bounds_(mesh.bounds()) {}
    [[nodiscard]] const Box& bounds() const { return bounds_; }
    [[nodiscard]] const Mesh& tree() const {
      std::call_once(made_, [&] { tree_ = make_mesh(triangles_); });
      return *tree_;
    }

   private:
    TriangleMesh triangles_;
    Box bounds_;
    mutable std::once_flag made_;
    mutable std::shared_ptr<Mesh> tree_;
  };
  /// Parts with their middles in one cube of kGroupM.
  struct Group {
    Box bounds;  ///< of all
    std::deque<Part> parts;
  };
  std::deque<Group> groups;

  explicit Impl(const std::vector<TriangleMesh>& meshes_world) {
    constexpr double kGroupM = 0.8;
    std::map<std::array<int, 3>, Group> by_cube;
    for (const TriangleMesh& mesh : meshes_world) {
      if (mesh.triangles.empty()) continue;
      const Box bounds = mesh.bounds();
      const VoxelIndex cube = voxel_at(bounds.center(), kGroupM);
      Group& group = by_cube[{cube.x(), cube.y(), cube.z()}];
      group.bounds.extend(bounds);
      group.parts.emplace_back(mesh);
    }
    for (auto& [cube, group] : by_cube) groups.push_back(std::move(group));
  }

  [[nodiscard]] bool touch(const Placed& placed) const {
    const auto touches_part = [&](const Part& part) {
      return part.bounds().intersects(placed.bounds) &&
             in_contact(placed.geometry, placed.T_world_shape, &part.tree(), Pose::Identity());
    };
    return std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
      return group.bounds.intersects(placed.bounds) &&
             std::any_of(group.parts.begin(), group.parts.end(), touches_part);
    });
  }
};

MeshObstacles::MeshObstacles(const std::vector<TriangleMesh>& meshes_world)
    : impl_(std::make_unique<Impl>(meshes_world)) {}
MeshObstacles::~MeshObstacles() = default;
MeshObstacles::MeshObstacles(MeshObstacles&&) noexcept = default;
MeshObstacles& MeshObstacles::operator=(MeshObstacles&&) noexcept = default;

struct ExactChecker::Impl {
  struct Part {
    int link = 0;
    CollisionShape shape;
    Geometry geometry;
  };

  const RobotModel* robot = nullptr;
  std::vector<Part> parts;
  MeshObstacles structure;

  [[nodiscard]] std::vector<Placed> place(const Configuration& q,
                                          const TrolleyState& trolley) const {
    std::vector<Pose> T_world_link;
    robot->link_poses(q, trolley, T_world_link);
    std::vector<Placed> placed;
    placed.reserve(parts.size());
    for (const Part& part : parts) {
      const Pose T = T_world_link[part.link] * part.shape.T_link_shape;
      const Vec3 half = part.shape.half_extents();
      placed.push_back({part.link, part.geometry.get(), T, transformed(Box(-half, half), T)});
    }
    return placed;
  }

  [[nodiscard]] const std::string& name(int link) const { return robot->links()[link].name; }
  [[nodiscard]] bool in_arm(int link) const { return robot->arm_joints_before(link) > 0; }

  bool find_self(const std::vector<Placed>& placed, std::string& pair) const {
    for (std::size_t i = 0; i < placed.size(); ++i) {
      for (std::size_t j = i + 1; j < placed.size(); ++j) {
        const Placed& a = placed[i];
        const Placed& b = placed[j];
        if (!robot->pair_checked(a.link, b.link) || !a.bounds.intersects(b.bounds)) continue;
        if (!in_contact(a.geometry, a.T_world_shape, b.geometry, b.T_world_shape)) continue;
        pair = name(a.link) + " / " + name(b.link);
        return true;
      }
    }
    return false;
  }

  bool find_structure(const std::vector<Placed>& placed, std::string& pair) const {
    for (const Placed& part : placed) {
      if (!in_arm(part.link) || !structure.impl_->touch(part)) continue;
      pair = name(part.link) + " / structure";
      return true;
    }
    return false;
  }

  bool find_map(const std::vector<Placed>& placed, const VoxelMap& map, std::string& pair) const {
    const double edge = map.resolution_m();
    const fcl::Boxd cube(edge, edge, edge);
    for (const Placed& part : placed) {
      if (!in_arm(part.link)) continue;
      // for_each_occupied goes by voxel centres.
      const Vec3 margin = Vec3::Constant(edge * 0.501);
      bool contact = false;
      map.for_each_occupied(Box(part.bounds.min() - margin, part.bounds.max() + margin),
                            [&](const VoxelIndex& voxel) {
                              if (contact) return;
                              Pose T_world_cube = Pose::Identity();
                              T_world_cube.translation() = voxel_centre(voxel, edge);
                              contact = in_contact(part.geometry, part.T_world_shape, &cube,
                                                   T_world_cube);
                            });
      if (!contact) continue;
      pair = name(part.link) + " / map";
      return true;
    }
    return false;
  }
};

ExactChecker::ExactChecker(const RobotModel& robot,
                           const std::vector<TriangleMesh>& structure_world)
    : impl_(new Impl{&robot, {}, MeshObstacles(structure_world)}) {
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    for (const CollisionShape& shape : robot.links()[i].collision)
      impl_->parts.push_back({static_cast<int>(i), shape, make_geometry(shape)});
  }
}
ExactChecker::~ExactChecker() = default;
ExactChecker::ExactChecker(ExactChecker&&) noexcept = default;
ExactChecker& ExactChecker::operator=(ExactChecker&&) noexcept = default;

ContactReport ExactChecker::check(const Configuration& q, const TrolleyState& trolley,
                                  const VoxelMap* map) const {
  const std::vector<Placed> placed = impl_->place(q, trolley);
  ContactReport report;
  std::string pair;
  const auto note = [&](bool contact) {
    if (contact && report.pair.empty()) report.pair = pair;
    return contact;
  };
  report.self = note(impl_->find_self(placed, pair));
  report.structure = note(impl_->find_structure(placed, pair));
  report.map = note(map != nullptr && impl_->find_map(placed, *map, pair));
  return report;
}

std::vector<std::string> ExactChecker::resting_contacts(const TrolleyState& trolley) const {
  std::vector<std::string> links;
  const Configuration anywhere = (impl_->robot->span().lower + impl_->robot->span().upper) / 2.0;
  for (const Placed& part : impl_->place(anywhere, trolley)) {
    const std::string& link = impl_->name(part.link);
    if (!impl_->in_arm(part.link) && (links.empty() || links.back() != link) &&
        impl_->structure.impl_->touch(part))
      links.push_back(link);
  }
  return links;
}

std::vector<std::pair<int, int>> ExactChecker::touching_pairs(const Configuration& q,
                                                              const TrolleyState& trolley) const {
  const std::vector<Placed> placed = impl_->place(q, trolley);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t j = i + 1; j < placed.size(); ++j) {
      const std::pair<int, int> pair = std::minmax(placed[i].link, placed[j].link);
      if (impl_->robot->rigidly_joined(pair.first, pair.second) ||
          std::find(pairs.begin(), pairs.end(), pair) != pairs.end() ||
          !placed[i].bounds.intersects(placed[j].bounds))
        continue;
      if (in_contact(placed[i].geometry, placed[i].T_world_shape, placed[j].geometry,
                     placed[j].T_world_shape))
        pairs.push_back(pair);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool ExactChecker::touches(const Configuration& q, const TrolleyState& trolley,
                           const MeshObstacles& obstacles) const {
  for (const Placed& part : impl_->place(q, trolley)) {
    if (impl_->in_arm(part.link) && obstacles.impl_->touch(part)) return true;
  }
  return false;
}

}  // namespace canopeer
