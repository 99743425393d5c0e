#include "canopeer/base/csv_table.h"

#include <algorithm>
#include <charconv>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/plain_text.h"

namespace canopeer {
namespace {

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = s.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

Expected<CsvTable> CsvTable::read(const std::filesystem::path& path) {
  const Expected<std::string> text = read_file(path);
  if (!text) return fail(text.error().message);
  return parse(*text, path.string());
}

Expected<CsvTable> CsvTable::parse(std::string_view text, std::string name) {
  CsvTable table;
  table.name_ = std::move(name);
  const PlainText plain(text);  // spreadsheets put a mark before it
  text = plain.view();
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view content = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (content.empty()) continue;
    std::vector<std::string> fields = fields_of(content);
    if (table.columns_.empty()) {
      table.columns_ = std::move(fields);
      continue;
    }
    if (fields.size() != table.columns_.size()) {
      return fail(table.name_ + ":" + std::to_string(line) + ": " + std::to_string(fields.size()) +
                  " fields, expected " + std::to_string(table.columns_.size()) +
                  " as in the header");
    }
    table.rows_.push_back(std::move(fields));
    table.lines_.push_back(line);
  }
  if (table.columns_.empty()) return fail(table.name_ + ": empty, expected a header line");
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

Expected<std::string> CsvTable::text(std::size_t row, std::string_view column) const {
  const std::optional<std::size_t> index = find(column);
  if (!index) return fail(name_ + ": column '" + std::string(column) + "' is missing");
  return rows_[row][*index];
}

Expected<double> CsvTable::number(std::size_t row, std::string_view column) const {
  const Expected<std::string> field = text(row, column);
  if (!field) return fail(field.error().message);
  if (const auto value = parsed<double>(*field)) return *value;
  return fail(name_ + ":" + std::to_string(lines_[row]) + ": '" + *field + "' in column '" +
              std::string(column) + "', expected a number");
}

Expected<int> CsvTable::integer(std::size_t row, std::string_view column) const {
  const Expected<std::string> field = text(row, column);
  if (!field) return fail(field.error().message);
  if (const auto value = parsed<int>(*field)) return *value;
  return fail(name_ + ":" + std::to_string(lines_[row]) + ": '" + *field + "' in column '" +
              std::string(column) + "', expected a whole number");
}

}  // namespace canopeer
