#pragma once

#include <unordered_map>

#include "canopeer/geometry/triangle_mesh.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// The cells of a grid that surfaces touch. It errs to one side: each cell that a triangle touches
/// is there, and some cells beside it, none farther away than an edge along each axis.
class TouchedCells {
 public:
  /// `edge_m`: of the grid's cells, which are a voxel map's of that resolution. Of what lies
  /// outside `within_world` not all is marked.
  TouchedCells(double edge_m, const Box& within_world) : edge_m_(edge_m), within_(within_world) {}

  /// Marks the cells of one mesh, placed by `T_world_mesh`.
  void add(const TriangleMesh& mesh, const Pose& T_world_mesh);

  TouchedCells(const TouchedCells&) = delete;
  TouchedCells& operator=(const TouchedCells&) = delete;

  /// By block: the cells marked so far.
  [[nodiscard]] const std::unordered_map<BlockKey, VoxelMask>& blocks() const { return blocks_; }

 private:
  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  void mark(const Box& box);

  double edge_m_;
  Box within_;
  std::unordered_map<BlockKey, VoxelMask> blocks_;
  BlockKey last_key_ = 0;
  VoxelMask* last_ = nullptr;  // the block of the cell marked last: the next one is near
};

}  // namespace canopeer
