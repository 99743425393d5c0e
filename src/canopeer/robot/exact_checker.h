#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/geometry/triangle_mesh.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

class VoxelMap;

/// What an exact check found. All kinds are looked for; `pair` names the first contact.
struct ContactReport {
  bool self = false;       ///< link against link, the trolley included
  bool structure = false;  ///< a link that moves with the arm against the fixed structure
  bool map = false;        ///< an arm link against an occupied voxel
  std::string pair;        ///< e.g. "forearm_link / lift_platform_link"; empty: no contact

  [[nodiscard]] bool any() const { return self || structure || map; }
};

/// Triangle meshes in world, ready for contact tests (a bounding volume hierarchy each).
class MeshObstacles {
 public:
  explicit MeshObstacles(const std::vector<TriangleMesh>& meshes_world);
  ~MeshObstacles();
  MeshObstacles(MeshObstacles&&) noexcept;
  MeshObstacles& operator=(MeshObstacles&&) noexcept;

 private:
  friend class ExactChecker;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The judge: FCL on the links' true shapes. Slow beside CollisionChecker; meant for tests and for
/// one look before a motion is executed. Const members are safe to call from several threads.
class ExactChecker {
 public:
  /// `structure_world`: floor, posts, boards, walls. `robot` must outlive the checker.
  explicit ExactChecker(const RobotModel& robot,
                        const std::vector<TriangleMesh>& structure_world = {});
  ~ExactChecker();
  ExactChecker(ExactChecker&&) noexcept;
  ExactChecker& operator=(ExactChecker&&) noexcept;

  /// Contacts in one state. Map: the links that move with the arm against every occupied voxel's
  /// cube; null: not asked.
  [[nodiscard]] ContactReport check(const Configuration& q, const TrolleyState& trolley,
                                    const VoxelMap* map = nullptr) const;

  /// Links that no arm joint moves and that touch the structure: a base on the floor, wheels on
  /// rails. No motion of the arm makes or ends such a contact, so check() leaves it out.
  [[nodiscard]] std::vector<std::string> resting_contacts(const TrolleyState& trolley) const;

  /// All pairs of links whose shapes touch, disabled ones too, but for those that are rigidly
  /// joined; indices of RobotModel::links(), the smaller first, sorted.
  [[nodiscard]] std::vector<std::pair<int, int>> touching_pairs(const Configuration& q,
                                                                const TrolleyState& trolley) const;

  /// Whether a link that moves with the arm touches one of the meshes (plants, say).
  [[nodiscard]] bool touches(const Configuration& q, const TrolleyState& trolley,
                             const MeshObstacles& obstacles) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
