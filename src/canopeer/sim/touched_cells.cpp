#include "canopeer/sim/touched_cells.h"

namespace canopeer {
namespace {

/// Triangles whose boxes are no larger than this part of a cell's edge are as good as their boxes.
constexpr double kSmall = 0.5;

}  // namespace

void TouchedCells::add(const TriangleMesh& mesh, const Pose& T_world_mesh) {
  std::vector<Vec3> corners;
  corners.reserve(mesh.vertices.size());
  for (const auto& v : mesh.vertices) corners.push_back(T_world_mesh * v.cast<double>());
  for (const auto& t : mesh.triangles) add(corners[t[0]], corners[t[1]], corners[t[2]]);
}

/// Cuts the triangle across its longest edge until its pieces are small.
void TouchedCells::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Box box(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
  if (!box.intersects(within_)) return;
  if (box.sizes().maxCoeff() <= kSmall * edge_m_) return mark(box);
  const double ab = (b - a).squaredNorm();
  const double bc = (c - b).squaredNorm();
  const double ca = (a - c).squaredNorm();
  if (ab < bc || ab < ca) return bc >= ca ? add(b, c, a) : add(c, a, b);
  const Vec3 middle = (a + b) / 2.0;
  add(a, middle, c);
  add(middle, b, c);
}

void TouchedCells::mark(const Box& box) {
  const VoxelIndex low = voxel_at(box.min(), edge_m_);
  const VoxelIndex high = voxel_at(box.max(), edge_m_);
  VoxelIndex cell;
  for (cell.z() = low.z(); cell.z() <= high.z(); ++cell.z()) {
    for (cell.y() = low.y(); cell.y() <= high.y(); ++cell.y()) {
      for (cell.x() = low.x(); cell.x() <= high.x(); ++cell.x()) {
        const BlockKey key = block_key(cell);
        if (last_ == nullptr || key != last_key_) {
          last_ = &blocks_[key];
          last_key_ = key;
        }
        last_->set(cell);
      }
    }
  }
}

}  // namespace canopeer
