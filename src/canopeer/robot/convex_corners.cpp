#include "canopeer/robot/convex_corners.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

std::vector<Vec3> corners_of(const std::vector<ShapeMesh::Plane>& planes) {
  double size = 1.0;
  for (const auto& plane : planes) size = std::max(size, std::abs(plane.offset_m));
  const double tolerance = 1e-9 * size;
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Vec3 along = planes[i].normal.cross(planes[j].normal);
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const double volume = along.dot(planes[k].normal);
        if (std::abs(volume) < 1e-3) continue;  // (nearly) parallel to one line
        const Vec3 p = (planes[i].offset_m * planes[j].normal.cross(planes[k].normal) +
                        planes[j].offset_m * planes[k].normal.cross(planes[i].normal) +
                        planes[k].offset_m * along) /
                       volume;
        const bool inside = std::all_of(planes.begin(), planes.end(), [&](const auto& plane) {
          return plane.normal.dot(p) <= plane.offset_m + tolerance;
        });
        const bool known =
            inside && std::any_of(corners.begin(), corners.end(), [&](const Vec3& c) {
              return (c - p).squaredNorm() < tolerance * tolerance;
            });
        if (inside && !known) corners.push_back(p);
      }
    }
  }
  return corners;
}

}  // namespace canopeer
