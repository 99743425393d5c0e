#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/sensing/files/point_columns.h"
#include "canopeer/sensing/files/table_dialect.h"

namespace canopeer {

/// What the columns of a table of points are; nothing: passed over.
using PointColumns = std::vector<std::optional<Column>>;

/// By the names in a head. Case, units of metres (x_m, x [m]) and prefixes of exporters do not
/// matter.
[[nodiscard]] PointColumns columns_of_head(const std::vector<std::string_view>& names);

/// True when x, y and z are among them.
[[nodiscard]] bool has_position(const PointColumns& columns);

/// Columns that no head names, as far as their values leave no doubt.
struct GuessedColumns {
  PointColumns columns;
  std::string notice;  ///< what was guessed, or passed over; empty: there are x, y and z only
};

/// `rows` are the first rows of the table, all as long as the first. A first column that counts
/// rows is one. Three columns of unit vectors are normals; three of whole numbers up to 255 are
/// colours. `after_intensity`: of seven columns the fourth is an intensity (.pts).
[[nodiscard]] GuessedColumns guess_columns(const std::vector<std::vector<double>>& rows,
                                           bool after_intensity);

}  // namespace canopeer
