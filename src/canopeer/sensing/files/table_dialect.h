#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace canopeer {

/// How a table of numbers is written as text.
struct TableDialect {
  /// Between fields. A blank: any run of blanks and tabs. 0: any run of , ; blanks and tabs.
  char separator = ' ';
  bool decimal_comma = false;  ///< 0,5 is a half
};

/// Guesses it from lines of the table; the last of them must be numbers.
[[nodiscard]] TableDialect dialect_of(const std::vector<std::string_view>& lines);

/// The fields of a line, without blanks and quotes around them. A field may be empty, the last one
/// too, unless the separator is a run.
void split_fields(std::string_view line, const TableDialect& dialect,
                  std::vector<std::string_view>& fields);

/// The number a field spells. Empty fields and what stands for a missing value (NA, null, -) are
/// NaN.
[[nodiscard]] std::optional<double> table_number(std::string_view field,
                                                 const TableDialect& dialect);

/// What follows #, // or % at the beginning of a line; nothing: the line is no comment.
[[nodiscard]] std::optional<std::string_view> comment_of(std::string_view line);

/// The line without blanks and tabs around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace canopeer
