#include "canopeer/sensing/files/cloud_table.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr std::size_t kEnoughRows = 5;  // to believe what all of them say

/// `x_m`, `x [m]` and `x (m)` are x.
std::string_view without_unit(std::string_view name) {
  for (const std::string_view unit : {"_m", "[m]", "(m)"}) {
    if (name.size() > unit.size() && name.ends_with(unit)) {
      return trimmed(name.substr(0, name.size() - unit.size()));
    }
  }
  return name;
}

template <typename Holds>
bool all_rows(const Rows& rows, const Holds& holds) {
  return rows.size() >= kEnoughRows && std::all_of(rows.begin(), rows.end(), holds);
}

bool counts_rows(const Rows& rows) {
  const double first = rows[0][0];
  if (rows.size() < kEnoughRows || (first != 0.0 && first != 1.0)) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i][0] != first + static_cast<double>(i)) return false;
  }
  return true;
}

/// Unit vectors, some of which look back: shares of colours never do.
bool are_normals(const Rows& rows, std::size_t at) {
  bool negative = false;
  return all_rows(rows,
                  [&](const std::vector<double>& row) {
                    negative |= std::min({row[at], row[at + 1], row[at + 2]}) < 0.0;
                    return std::abs(std::hypot(row[at], row[at + 1], row[at + 2]) - 1.0) < 0.01;
                  }) &&
         negative;
}

bool are_colors(const Rows& rows, std::size_t at) {
  double largest = 0.0;
  return all_rows(rows,
                  [&](const std::vector<double>& row) {
                    for (std::size_t i = at; i < at + 3; ++i) {
                      largest = std::max(largest, row[i]);
                      if (!(row[i] >= 0.0 && row[i] <= 255.0 && row[i] == std::floor(row[i])))
                        return false;
                    }
                    return true;
                  }) &&
         largest > 1.0;
}

bool holds(const PointColumns& columns, Column column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::string range_of(std::size_t from, std::size_t to) {
  return (from == to ? "column " : "columns ") + std::to_string(from) +
         (from == to ? "" : " to " + std::to_string(to));
}

}  // namespace

PointColumns columns_of_head(const std::vector<std::string_view>& names) {
  PointColumns columns;
  for (const std::string_view name : names) columns.push_back(column_named(without_unit(name)));
  return columns;
}

bool has_position(const PointColumns& columns) {
  return holds(columns, Column::x) && holds(columns, Column::y) && holds(columns, Column::z);
}

GuessedColumns guess_columns(const Rows& rows, bool after_intensity) {
  GuessedColumns guessed;
  const std::size_t count = rows[0].size();
  guessed.columns.resize(count);
  std::vector<std::string> taken;
  std::size_t at = count > 3 && counts_rows(rows) ? 1 : 0;
  if (at > 0) taken.push_back("column 1 counts the rows");
  for (const Column column : {Column::x, Column::y, Column::z}) {
    if (at < count) guessed.columns[at++] = column;
  }
  if (after_intensity && count == 7)
    taken.push_back("column " + std::to_string(++at) + " passed over");
  for (; at + 3 <= count; at += 3) {
    const bool normals = are_normals(rows, at);
    if (!normals && !are_colors(rows, at)) break;
    const Column first = normals ? Column::nx : Column::red;
    if (holds(guessed.columns, first)) break;
    for (std::size_t i = 0; i < 3; ++i) {
      guessed.columns[at + i] = static_cast<Column>(static_cast<std::size_t>(first) + i);
    }
    taken.push_back(range_of(at + 1, at + 3) + (normals ? " are normals" : " are colours"));
  }
  if (at < count) taken.push_back(range_of(at + 1, count) + " passed over");
  for (const std::string& part : taken)
    guessed.notice += (guessed.notice.empty() ? "" : ", ") + part;
  return guessed;
}

}  // namespace canopeer
