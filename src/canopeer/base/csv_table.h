#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// A CSV file with a header line, without quoting: what this project writes. Columns are found by
/// name, so their order does not matter and extra ones do not disturb.
class CsvTable {
 public:
  /// The error names the file, and the line where it is malformed.
  [[nodiscard]] static Expected<CsvTable> read(const std::filesystem::path& path);
  /// `name` stands for the file in error messages.
  [[nodiscard]] static Expected<CsvTable> parse(std::string_view text, std::string name);

  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] bool has(std::string_view column) const { return find(column).has_value(); }
  /// The error names file, line and column.
  [[nodiscard]] Expected<std::string> text(std::size_t row, std::string_view column) const;
  [[nodiscard]] Expected<double> number(std::size_t row, std::string_view column) const;
  [[nodiscard]] Expected<int> integer(std::size_t row, std::string_view column) const;

 private:
  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;
  std::string name_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<int> lines_;  ///< of the file, one per row
};

}  // namespace canopeer
