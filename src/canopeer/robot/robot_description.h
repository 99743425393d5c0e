#pragma once

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

enum class ShapeKind { kBox, kCylinder, kSphere, kMesh };

/// A triangle mesh as a part of a robot, and the convex solid that stands for it in fast checks.
struct ShapeMesh {
  /// The plane of a face of the solid.
  struct Plane {
    Vec3 normal = Vec3::UnitZ();  ///< unit, outwards
    double offset_m = 0.0;        ///< normal · p ≤ offset_m inside
  };
  std::string file;  ///< where it was read from
  TriangleMesh triangles;
  std::vector<Plane> planes;  ///< the smallest solid around it with faces in 26 fixed directions
  std::vector<Vec3> corners;  ///< of that solid
};

/// A solid placed in a link: convex and centred at its own origin, or a mesh with its bounding box
/// centred there.
struct CollisionShape {
  ShapeKind kind = ShapeKind::kSphere;
  Vec3 size_m = Vec3::Zero();  ///< box: edge lengths; cylinder (about z): radius, radius, length;
                               ///< sphere: radius three times; mesh: edges of its bounding box
  Pose T_link_shape = Pose::Identity();
  std::shared_ptr<const ShapeMesh> mesh{};  ///< of a mesh, else null

  /// A mesh given in the frame T_link_mesh; it must have triangles.
  static CollisionShape of_mesh(TriangleMesh triangles, const Pose& T_link_mesh, std::string file);

  static CollisionShape box(const Vec3& edges_m, const Pose& T_link_shape = Pose::Identity()) {
    return {ShapeKind::kBox, edges_m, T_link_shape, nullptr};
  }
  static CollisionShape cylinder(double radius_m, double length_m,
                                 const Pose& T_link_shape = Pose::Identity()) {
    return {ShapeKind::kCylinder, Vec3(radius_m, radius_m, length_m), T_link_shape, nullptr};
  }
  static CollisionShape sphere(double radius_m, const Pose& T_link_shape = Pose::Identity()) {
    return {ShapeKind::kSphere, Vec3::Constant(radius_m), T_link_shape, nullptr};
  }
  /// Half edge lengths of the smallest box around it, axes of the shape.
  [[nodiscard]] Vec3 half_extents() const {
    if (kind == ShapeKind::kBox || kind == ShapeKind::kMesh) return size_m / 2.0;
    if (kind == ShapeKind::kCylinder) return {size_m.x(), size_m.x(), size_m.z() / 2.0};
    return size_m;
  }
};

/// A rigid part of the robot. Its shapes are in the frame of the link.
struct Link {
  std::string name;
  std::vector<CollisionShape> collision;  ///< empty: a frame only
  std::vector<CollisionShape> visual{};   ///< for pictures only; empty: the collision shapes
};

/// The last two move in a plane at right angles to the axis, and anyhow.
enum class JointType { kFixed, kRevolute, kPrismatic, kPlanar, kFloating };

/// Moves `child` against `parent`: T_parent_child = T_parent_joint · motion(q about or along axis).
/// Units: rad, rad/s, rad/s² (revolute) or m, m/s, m/s² (prismatic). A revolute joint without
/// limits turns without end.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;
  std::string child;
  Pose T_parent_joint = Pose::Identity();
  Vec3 axis = Vec3::UnitZ();  ///< unit vector, joint frame
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double velocity_limit = std::numeric_limits<double>::infinity();
  double acceleration_limit = std::numeric_limits<double>::infinity();
  /// The joint it follows: its position is multiplier · (the other's) + offset. Empty: none.
  std::string mimics{};
  double multiplier = 1.0;
  double offset = 0.0;
  /// Controllers that know them hold the joint within these; here they are only spoken of.
  double soft_lower = -std::numeric_limits<double>::infinity();
  double soft_upper = std::numeric_limits<double>::infinity();
  std::string flaw{};   ///< why nothing can move it ("its <limit> …"); empty: it can
  std::string place{};  ///< where it was read, "file:line"; empty: nowhere
};

/// A robot as its files (URDF, SRDF) tell it: a tree of links, plain values.
struct RobotDescription {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  /// Pairs of links that need no self-collision check: neighbours, and pairs that can never meet.
  std::vector<std::pair<std::string, std::string>> disabled_pairs;
  /// No SRDF says which pairs those are: links that a joint connects need no check.
  bool neighbours_may_touch = false;
  std::vector<std::string> notices;  ///< what its files lack but can be done without
};

}  // namespace canopeer
