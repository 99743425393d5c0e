#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/base/plain_text.h"
#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/cloud_table.h"

namespace canopeer {
namespace {

using Fields = std::vector<std::string_view>;

constexpr std::size_t kSampleLines = 100;

bool is_number(std::string_view field, const TableDialect& dialect) {
  return table_number(field, dialect).has_value();
}

/// A line with nothing but a whole number: how many points follow (.pts).
std::optional<std::int64_t> count_in(std::string_view line) {
  const auto count = to_integer(trimmed(line));
  return count && *count >= 0 ? count : std::nullopt;
}

class TableParser {
 public:
  TableParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Expected<CloudFile> parse() {
    take_sample();
    dialect_ = dialect_of(sample_);
    if (auto done = find_columns(); !done) return tl::unexpected(done.error());
    for (const auto& column : columns_) {
      // Positions, normals and colours are real; no type says how far colours go.
      if (column) cloud_.declare(*column, NumberType::f64);
    }
    if (auto done = read_rows(); !done) return tl::unexpected(done.error());
    if (counts_points_ && points_ != stated_points_) {
      return fail(name_ + ": holds " + std::to_string(points_) + " of the " +
                  std::to_string(stated_points_) +
                  " points it states: the file was cut off, or the number is wrong");
    }
    CloudFile file = cloud_.take();
    file.notices = std::move(notices_);
    return file;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> fail_at(int line, const std::string& message) const {
    return fail(name_ + ":" + std::to_string(line) + ": " + message);
  }

  /// The first lines that are no comments, and comments that name columns.
  void take_sample() {
    TextLines lines(text_);
    while (const auto line = lines.next()) {
      if (sample_.size() == kSampleLines) break;
      if (trimmed(*line).empty()) continue;
      if (const auto comment = comment_of(*line)) {
        if (sample_.empty()) take_head_in_comment(*comment, lines.number());
        continue;
      }
      if (sample_.empty() && !counts_points_ && count_in(*line)) {
        counts_points_ = true;
        continue;
      }
      if (counts_points_ && count_in(*line)) continue;  // the next scan begins
      if (sample_.empty()) first_line_ = lines.number();
      sample_.push_back(*line);
    }
  }

  void take_head_in_comment(std::string_view comment, int line) {
    Fields names;
    for (const char separator : {',', ';', '\t', ' ', '\0'}) {
      split_fields(comment, {separator, false}, names);
      if (has_position(columns_of_head(names))) {
        head_ = names;
        head_line_ = line;
        return;
      }
    }
  }

  Expected<void> find_columns() {
    if (sample_.empty() && head_.empty()) return fail_at(1, "expected columns x, y and z");
    Fields first;
    if (!sample_.empty()) split_fields(sample_[0], dialect_, first);
    const bool numbers = std::all_of(first.begin(), first.end(), [&](std::string_view field) {
      return is_number(field, dialect_);
    });
    if (!sample_.empty() && !numbers) {
      head_ = first;
      head_line_ = first_line_;
      sample_.erase(sample_.begin());
      has_head_line_ = true;
    }
    if (head_.empty()) return guess();
    columns_ = columns_of_head(head_);
    if (!has_position(columns_)) {
      std::string found;
      for (const auto name : head_) found += (found.empty() ? "" : ", ") + std::string(name);
      return fail_at(head_line_, "expected columns x, y and z, found " + found.substr(0, 120));
    }
    add_row_names();
    return {};
  }

  /// Some writers number the rows, or name them, and have no name for that column.
  void add_row_names() {
    Fields fields;
    for (std::size_t i = 0; i < sample_.size(); ++i) {
      split_fields(sample_[i], dialect_, fields);
      if (fields.size() != columns_.size() + 1 || fields.back().empty()) return;
      const auto number = to_integer(fields[0]);
      if (number && *number != static_cast<std::int64_t>(i) &&
          *number != static_cast<std::int64_t>(i) + 1) {
        return;
      }
      if (!number && is_number(fields[0], dialect_)) return;
    }
    if (!sample_.empty()) columns_.insert(columns_.begin(), std::nullopt);
  }

  Expected<void> guess() {
    std::vector<std::vector<double>> rows;
    Fields fields;
    for (const std::string_view line : sample_) {
      split_fields(line, dialect_, fields);
      if (looks_like_decimal_commas(fields)) {
        return fail_at(first_line_,
                       "commas stand between the columns and within the numbers; separate the "
                       "columns by semicolons");
      }
      std::vector<double>& row = rows.emplace_back();
      for (const auto field : fields) {
        row.push_back(table_number(field, dialect_).value_or(std::nan("")));
      }
      if (row.size() != rows[0].size()) rows.pop_back();
    }
    GuessedColumns guessed = guess_columns(rows, counts_points_);
    columns_ = std::move(guessed.columns);
    if (!has_position(columns_)) return fail_at(first_line_, "expected columns x, y and z");
    if (!guessed.notice.empty()) {
      notices_.push_back(name_ + ": no line names the columns: " + guessed.notice);
    }
    return {};
  }

  /// 0,51568,0,17767,1,06709: among what may be x, y and z, a whole number begins with a zero, or
  /// each second one has as many digits, more than a colour has. Colours may follow.
  [[nodiscard]] bool looks_like_decimal_commas(const Fields& fields) const {
    if (dialect_.separator != ',' || fields.size() < 6) return false;
    for (const auto field : fields) {
      if (field.find('.') != std::string_view::npos) return false;
    }
    bool leading_zero = false, as_long = fields[1].size() > 3;
    for (const std::size_t i : {1, 3, 5}) {
      leading_zero |= fields[i].size() > 1 && fields[i][0] == '0';
      as_long &= fields[i].size() == fields[1].size();
    }
    return leading_zero || as_long;
  }

  Expected<void> read_rows() {
    TextLines lines(text_);
    Fields fields;
    while (const auto line = lines.next()) {
      if (has_head_line_ && lines.number() == head_line_) continue;
      if (trimmed(*line).empty() || comment_of(*line)) continue;
      if (const auto count = counts_points_ ? count_in(*line) : std::nullopt) {
        // No point is shorter than a byte.
        if (*count > static_cast<std::int64_t>(text_.size()) - stated_points_) {
          return fail_at(lines.number(), "states " + std::to_string(*count) +
                                             " points, more than the file has room for: it was "
                                             "cut off, or the number is wrong");
        }
        stated_points_ += *count;
        continue;
      }
      split_fields(*line, dialect_, fields);
      if (fields.size() == columns_.size() + 1 && fields.back().empty()) fields.pop_back();
      if (fields.size() + 1 == columns_.size() && !columns_.back()) fields.push_back({});
      if (fields.size() != columns_.size()) return wrong_width(lines.number(), fields.size());
      if (auto done = read_row(fields, lines.number()); !done) return done;
    }
    return {};
  }

  [[nodiscard]] tl::unexpected<Error> wrong_width(int line, std::size_t found) const {
    const bool commas = dialect_.separator == ',' && found > columns_.size();
    return fail_at(line, "expected " + std::to_string(columns_.size()) + " values, found " +
                             std::to_string(found) +
                             (commas ? "; if these are decimal commas, separate the columns by "
                                       "semicolons"
                                     : ""));
  }

  Expected<void> read_row(const Fields& fields, int line) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i]) continue;
      if (columns_[i] == Column::rgb && set_hex_color(fields[i])) continue;
      const auto value = table_number(fields[i], dialect_);
      if (!value) {
        return fail_at(line,
                       "expected a number, found '" + std::string(fields[i].substr(0, 40)) + "'");
      }
      if (columns_[i] == Column::rgb) {
        const bool whole = to_integer(fields[i]).has_value();
        cloud_.set_packed_rgb(whole ? NumberType::u32 : NumberType::f32, *value);
      } else {
        cloud_.set(*columns_[i], *value);
      }
    }
    cloud_.finish_point();
    ++points_;
    return {};
  }

  /// #rrggbb
  bool set_hex_color(std::string_view field) {
    if (field.size() != 7 || field[0] != '#') return false;
    std::uint32_t bits = 0;
    const auto [end, error] = std::from_chars(field.data() + 1, field.data() + 7, bits, 16);
    if (error != std::errc() || end != field.data() + 7) return false;
    cloud_.set_packed_rgb(bits);
    return true;
  }

  std::string_view text_;
  const std::string& name_;
  std::vector<std::string_view> sample_;
  int first_line_ = 1;  // of the sample
  TableDialect dialect_;
  Fields head_;
  int head_line_ = 1;
  bool has_head_line_ = false;  // it is no comment
  PointColumns columns_;
  bool counts_points_ = false;  // the first line says how many there are
  std::int64_t stated_points_ = 0, points_ = 0;
  std::vector<std::string> notices_;
  CloudBuilder cloud_;
};

}  // namespace

Expected<CloudFile> parse_csv_cloud(std::string_view bytes, const std::string& name) {
  const PlainText text(bytes);
  if (!text.is_text()) return fail(name + ": holds zero bytes: it is no text");
  return TableParser(text.view(), name).parse();
}

}  // namespace canopeer
