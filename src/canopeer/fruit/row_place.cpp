#include "canopeer/fruit/row_place.h"

#include <cmath>
#include <limits>

namespace canopeer {

std::optional<RowPlace> place_in_rows(std::span<const PlantRow> rows, const Vec3& p_world) {
  std::optional<RowPlace> place;
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlantRow& row : rows) {
    const Vec3 d = p_world - row.start;
    const Vec3 left = Vec3::UnitZ().cross(row.direction);
    const double lateral = d.dot(left);
    if (std::abs(lateral) >= nearest) continue;
    nearest = std::abs(lateral);
    place = RowPlace{row.name, lateral >= 0.0 ? 'L' : 'R', d.dot(row.direction), d.z()};
  }
  return place;
}

}  // namespace canopeer
