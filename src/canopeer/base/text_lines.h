#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace canopeer {

/// Walks through text line by line; a line ends with `\n`, `\r\n` or the text. The text must
/// outlive it.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  /// The next line without its end, or nothing: that was all.
  std::optional<std::string_view> next();
  /// Number of the line last given, from 1.
  [[nodiscard]] int number() const { return number_; }
  /// What follows the line last given.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// What stands between blanks and tabs, or other separators.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line,
                                                     std::string_view separators = " \t");

/// The number a whole word spells (nan and inf too), with a point whatever the locale.
[[nodiscard]] std::optional<double> to_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);

}  // namespace canopeer
