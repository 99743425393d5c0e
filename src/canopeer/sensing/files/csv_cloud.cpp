#include <algorithm>
#include <string>
#include <vector>

#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/point_columns.h"

namespace canopeer {
namespace {

constexpr std::string_view kSeparators = ",; \t";

bool is_numbers(const std::vector<std::string_view>& words) {
  return std::all_of(words.begin(), words.end(),
                     [](std::string_view word) { return to_number(word).has_value(); });
}

/// `x_m` and `X` mean x too.
std::optional<Column> column_of_head(std::string_view word) {
  std::string name(word);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (name.size() > 2 && name.ends_with("_m")) name.resize(name.size() - 2);
  return column_named(name);
}

/// Positions are real, colours 0 … 255, normals real.
NumberType type_of(Column column) {
  const bool color = column == Column::red || column == Column::green || column == Column::blue;
  return color ? NumberType::u8 : NumberType::f64;
}

}  // namespace

Expected<CloudFile> parse_csv_cloud(std::string_view bytes, const std::string& name) {
  TextLines lines(bytes);
  CloudBuilder cloud;
  std::vector<std::optional<Column>> columns;
  const auto here = [&](const std::string& message) {
    return fail(name + ":" + std::to_string(lines.number()) + ": " + message);
  };
  while (const auto line = lines.next()) {
    const auto words = words_of(*line, kSeparators);
    if (words.empty() || words[0][0] == '#') continue;
    if (columns.empty()) {
      const bool headless = is_numbers(words);
      if (headless) {
        // Without a head: x y z, and then normals or colours would be a guess.
        columns = {Column::x, Column::y, Column::z};
        columns.resize(std::max(columns.size(), words.size()));
      } else {
        for (const auto& word : words) columns.push_back(column_of_head(word));
      }
      for (const auto& column : columns) {
        if (column) cloud.declare(*column, type_of(*column));
      }
      if (!cloud.has_position()) return here("expected columns x, y and z");
      if (!headless) continue;
    }
    if (words.size() != columns.size()) {
      return here("expected " + std::to_string(columns.size()) + " values, found " +
                  std::to_string(words.size()));
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!columns[i] || *columns[i] == Column::rgb) continue;
      const auto value = to_number(words[i]);
      if (!value) return here("expected a number, found '" + std::string(words[i]) + "'");
      cloud.set(*columns[i], *value);
    }
    cloud.finish_point();
  }
  return cloud.take();
}

}  // namespace canopeer
