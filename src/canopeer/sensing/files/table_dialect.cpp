#include "canopeer/sensing/files/table_dialect.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "canopeer/base/text_lines.h"

namespace canopeer {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::string_view kAnySeparators = ",; \t";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// One comma between digits, and no point: 0,5 or -12,75e-3.
bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < word.size() &&
         is_digit(word[comma - 1]) && is_digit(word[comma + 1]) &&
         word.find(',', comma + 1) == std::string_view::npos &&
         word.find('.') == std::string_view::npos;
}

std::size_t fields_by(char separator, std::string_view line) {
  std::vector<std::string_view> fields;
  split_fields(line, {separator, false}, fields);
  return fields.size();
}

bool all_lines_have(const std::vector<std::string_view>& lines, char separator, std::size_t count) {
  return std::all_of(lines.begin(), lines.end(),
                     [&](std::string_view line) { return fields_by(separator, line) == count; });
}

/// Numbers between commas and between blanks: 1,2,3 255 0 0.
bool mixes_commas_and_blanks(std::string_view line) {
  std::vector<std::string_view> fields;
  split_fields(line, {',', false}, fields);
  bool mixed = false;
  for (const std::string_view field : fields) {
    const std::vector<std::string_view> words = words_of(field, kBlanks);
    mixed |= words.size() > 1;
    for (const std::string_view word : words) {
      if (!to_number(word)) return false;
    }
  }
  return mixed;
}

char separator_of(const std::vector<std::string_view>& lines) {
  const std::string_view line = lines.back();
  if (fields_by(';', line) >= 3) return ';';
  if (fields_by('|', line) >= 3) return '|';
  const std::vector<std::string_view> words = words_of(line, kBlanks);
  if (fields_by('\t', line) >= 3) {
    // Tabs may align columns as blanks do. Missing values and names with blanks tell.
    return all_lines_have(lines, ' ', words.size()) ? ' ' : '\t';
  }
  const bool comma = line.find(',') != std::string_view::npos;
  if (!comma && line.find(';') == std::string_view::npos) return ' ';
  const bool blanks = words.size() >= 3 && std::none_of(words.begin(), words.end(), [](auto word) {
                        return word.find(',') != std::string_view::npos && !has_decimal_comma(word);
                      });
  if (blanks) return ' ';
  return mixes_commas_and_blanks(line) ? '\0' : ',';
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<std::string_view> comment_of(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with("//")) return trimmed(line.substr(2));
  if (!line.empty() && (line[0] == '#' || line[0] == '%')) return trimmed(line.substr(1));
  return std::nullopt;
}

TableDialect dialect_of(const std::vector<std::string_view>& lines) {
  TableDialect dialect;
  if (lines.empty()) return dialect;
  dialect.separator = separator_of(lines);
  if (dialect.separator == '\0') return dialect;
  std::vector<std::string_view> fields;
  for (const std::string_view line : lines) {
    split_fields(line, dialect, fields);  // with commas between fields, only quoted ones hold any
    dialect.decimal_comma |= std::any_of(fields.begin(), fields.end(), has_decimal_comma);
  }
  return dialect;
}

void split_fields(std::string_view line, const TableDialect& dialect,
                  std::vector<std::string_view>& fields) {
  fields.clear();
  const bool run = dialect.separator == ' ' || dialect.separator == '\0';
  const std::string_view separators = dialect.separator == ' '    ? kBlanks
                                      : dialect.separator == '\0' ? kAnySeparators
                                                                  : std::string_view();
  const auto next_separator = [&](std::size_t at) {
    return run ? line.find_first_of(separators, at) : line.find(dialect.separator, at);
  };
  std::size_t at = 0;
  while (at <= line.size()) {
    // Blanks before a field; of runs the whole run.
    at = line.find_first_not_of(run ? separators : dialect.separator == '\t' ? " " : kBlanks, at);
    if (at == std::string_view::npos) {
      if (!run && !fields.empty()) fields.push_back({});
      break;
    }
    std::size_t end = std::string_view::npos;
    const std::size_t quote =
        line[at] == '"' || line[at] == '\'' ? line.find(line[at], at + 1) : std::string_view::npos;
    if (quote != std::string_view::npos) {
      fields.push_back(trimmed(line.substr(at + 1, quote - at - 1)));
      end = next_separator(quote + 1);
    } else {
      end = next_separator(at);
      fields.push_back(trimmed(line.substr(at, end - at)));
    }
    if (end == std::string_view::npos) break;
    at = end + 1;
  }
}

std::optional<double> table_number(std::string_view field, const TableDialect& dialect) {
  if (const auto number = to_number(field)) return number;
  constexpr std::array<std::string_view, 9> kMissing = {"",     "-",    "NA",   "N/A", "#N/A",
                                                        "null", "NULL", "None", "none"};
  if (std::find(kMissing.begin(), kMissing.end(), field) != kMissing.end()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (!dialect.decimal_comma || !has_decimal_comma(field)) return std::nullopt;
  std::string with_point(field);
  with_point[with_point.find(',')] = '.';
  return to_number(with_point);
}

}  // namespace canopeer
