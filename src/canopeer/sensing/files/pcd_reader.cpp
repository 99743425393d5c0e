#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/lzf.h"
#include "canopeer/sensing/files/point_columns.h"

namespace canopeer {
namespace {

struct Field {
  NumberType type = NumberType::f32;
  std::size_t count = 1;  // numbers, of which the first is the column's
  std::optional<Column> column;
  [[nodiscard]] std::size_t bytes() const { return size_of(type) * count; }
};

std::optional<NumberType> type_of(std::string_view letter, std::int64_t size) {
  if (letter == "F" && size == 4) return NumberType::f32;
  if (letter == "F" && size == 8) return NumberType::f64;
  const bool is_signed = letter == "I";
  if (!is_signed && letter != "U") return std::nullopt;
  switch (size) {
    case 1:
      return is_signed ? NumberType::i8 : NumberType::u8;
    case 2:
      return is_signed ? NumberType::i16 : NumberType::u16;
    case 4:
      return is_signed ? NumberType::i32 : NumberType::u32;
    case 8:
      return is_signed ? NumberType::i64 : NumberType::u64;
    default:
      return std::nullopt;
  }
}

// PCD 0.7 as the Point Cloud Library describes it.
class PcdParser {
 public:
  PcdParser(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  Expected<CloudFile> parse() {
    if (auto done = read_header(); !done) return tl::unexpected(done.error());
    if (auto done = make_fields(); !done) return tl::unexpected(done.error());
    Expected<void> done;
    if (data_ == "ascii") {
      done = read_text();
    } else if (data_ == "binary") {
      done = read_binary(lines_.rest());
    } else {
      done = read_compressed(lines_.rest());
    }
    if (!done) return tl::unexpected(done.error());
    CloudFile file = cloud_.take();
    file.T_world_points = viewpoint_;
    return file;
  }

 private:
  using Words = std::vector<std::string_view>;

  tl::unexpected<Error> fail_here(const std::string& message) const {
    return fail(name_ + ":" + std::to_string(lines_.number()) + ": " + message);
  }

  Expected<void> read_header() {
    while (const auto line = lines_.next()) {
      auto words = words_of(*line);
      if (words.empty() || words[0][0] == '#') continue;
      const std::string_view key = words[0];
      words.erase(words.begin());
      if (key == "FIELDS" || key == "COLUMNS") {
        names_ = words;
      } else if (key == "SIZE" || key == "COUNT" || key == "WIDTH" || key == "HEIGHT" ||
                 key == "POINTS") {
        if (auto done = read_integers(key, words); !done) return done;
      } else if (key == "TYPE") {
        types_ = words;
      } else if (key == "VIEWPOINT") {
        if (auto done = read_viewpoint(words); !done) return done;
      } else if (key == "DATA") {
        data_ = words.empty() ? "" : words[0];
        if (data_ == "ascii" || data_ == "binary" || data_ == "binary_compressed") return {};
        return fail_here("expected DATA ascii, binary or binary_compressed");
      } else if (key != "VERSION") {
        return fail_here(lines_.number() == 1
                             ? "not a PCD file"
                             : "unknown key \"" + std::string(key.substr(0, 40)) + "\"");
      }
    }
    return fail(name_ + ": the header has no line \"DATA …\": no PCD file, or cut off");
  }

  Expected<void> read_integers(std::string_view key, const Words& words) {
    std::vector<std::int64_t> numbers;
    for (const auto word : words) {
      const auto number = to_integer(word);
      if (!number || *number < 0) {
        return fail_here(std::string(key) + ": expected whole numbers, got \"" +
                         std::string(word.substr(0, 40)) + "\"");
      }
      numbers.push_back(*number);
    }
    if (key == "SIZE") {
      sizes_ = numbers;
    } else if (key == "COUNT") {
      counts_ = numbers;
    } else {
      if (numbers.size() != 1) return fail_here(std::string(key) + ": expected one number");
      (key == "WIDTH" ? width_ : key == "HEIGHT" ? height_ : points_) = numbers[0];
    }
    return {};
  }

  Expected<void> read_viewpoint(const Words& words) {
    double v[7];
    bool numbers = words.size() == 7;
    for (std::size_t i = 0; numbers && i < 7; ++i) {
      const auto value = to_number(words[i]);
      numbers = value && std::isfinite(*value);
      if (numbers) v[i] = *value;
    }
    if (!numbers) return fail_here("VIEWPOINT: expected the 7 numbers tx ty tz qw qx qy qz");
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    if (std::abs(q.norm() - 1.0) > 0.05) {
      return fail_here("VIEWPOINT: the quaternion's length is not 1");
    }
    Pose pose = Pose::Identity();
    pose.linear() = q.normalized().toRotationMatrix();
    pose.translation() = Vec3(v[0], v[1], v[2]);
    if (!pose.isApprox(Pose::Identity())) viewpoint_ = pose;
    return {};
  }

  Expected<void> make_fields() {
    if (counts_.empty()) counts_.assign(names_.size(), 1);
    if (names_.empty() || sizes_.size() != names_.size() || types_.size() != names_.size() ||
        counts_.size() != names_.size()) {
      return fail(name_ + ": FIELDS, SIZE, TYPE and COUNT must have as many entries each");
    }
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto type = type_of(types_[i], sizes_[i]);
      if (!type || counts_[i] < 1 || counts_[i] > kMaxCount) {
        return fail(name_ + ": field \"" + std::string(names_[i].substr(0, 40)) +
                    "\" has no valid SIZE, TYPE and COUNT");
      }
      Field field{*type, static_cast<std::size_t>(counts_[i]), column_named(names_[i])};
      if (field.column) cloud_.declare(*field.column, field.type);
      point_bytes_ += field.bytes();
      fields_.push_back(field);
    }
    if (!cloud_.has_position()) return fail(name_ + ": has no fields x, y and z");
    if (points_ < 0 && width_ >= 0 && height_ >= 0 && width_ <= kMaxSide && height_ <= kMaxSide) {
      points_ = width_ * height_;
    }
    if (points_ < 0) return fail(name_ + ": has neither POINTS nor WIDTH and HEIGHT");
    return {};
  }

  Expected<void> read_text() {
    std::size_t numbers = 0;
    for (const Field& field : fields_) numbers += field.count;
    cloud_.reserve(
        std::min(static_cast<std::size_t>(points_), lines_.rest().size() / (2 * numbers) + 1));
    for (std::int64_t i = 0; i < points_; ++i) {
      const auto line = lines_.next();
      if (!line) return cut_off(static_cast<std::size_t>(i));
      const auto words = words_of(*line);
      if (words.size() != numbers) return wrong_numbers(numbers);
      std::size_t at = 0;
      for (const Field& field : fields_) {
        const auto value = to_number(words[at]);
        if (!value) return wrong_numbers(numbers);
        if (field.column) set(field, *value);
        at += field.count;
      }
      cloud_.finish_point();
    }
    return {};
  }

  tl::unexpected<Error> wrong_numbers(std::size_t numbers) const {
    return fail_here("expected " + std::to_string(numbers) + " numbers for each point");
  }

  tl::unexpected<Error> cut_off(std::size_t points) const {
    return fail(name_ + ": holds " + std::to_string(points) + " of " + std::to_string(points_) +
                " points: the file was cut off");
  }

  // Point after point.
  Expected<void> read_binary(std::string_view data) {
    if (static_cast<std::size_t>(points_) > data.size() / point_bytes_) {
      return cut_off(data.size() / point_bytes_);
    }
    cloud_.reserve(static_cast<std::size_t>(points_));
    for (std::int64_t i = 0; i < points_; ++i) {
      for (const Field& field : fields_) {
        if (field.column) load(field, data.data());
        data.remove_prefix(field.bytes());
      }
      cloud_.finish_point();
    }
    return {};
  }

  // Two sizes, then LZF: field after field, each for all points.
  Expected<void> read_compressed(std::string_view data) {
    if (data.size() < 8) return cut_off(0);
    const std::size_t compressed = load_number<std::uint32_t>(data.data());
    const std::size_t size = load_number<std::uint32_t>(data.data() + 4);
    data.remove_prefix(8);
    if (data.size() < compressed) return cut_off(0);
    const auto points = static_cast<std::size_t>(points_);
    if (points > size / point_bytes_ || points * point_bytes_ != size) {
      return fail(name_ + ": the compressed data and POINTS do not agree");
    }
    const auto content = lzf_decompress(data.substr(0, compressed), size);
    if (!content) return fail(name_ + ": the compressed data is damaged");
    cloud_.reserve(points);
    for (std::size_t i = 0; i < points; ++i) {
      const char* at = content->data();
      for (const Field& field : fields_) {
        if (field.column) load(field, at + i * field.bytes());
        at += points * field.bytes();
      }
      cloud_.finish_point();
    }
    return {};
  }

  void load(const Field& field, const char* bytes) {
    if (field.column == Column::rgb && size_of(field.type) == 4) {
      cloud_.set_packed_rgb(load_number<std::uint32_t>(bytes));  // whatever TYPE calls it
    } else {
      set(field, load_as_double(field.type, bytes, ByteOrder::little));
    }
  }

  void set(const Field& field, double value) {
    if (field.column == Column::rgb) {
      cloud_.set_packed_rgb(field.type, value);
    } else {
      cloud_.set(*field.column, value);
    }
  }

  static constexpr std::int64_t kMaxCount = 65536;
  static constexpr std::int64_t kMaxSide = std::int64_t{1} << 31;

  TextLines lines_;
  const std::string& name_;
  Words names_, types_;
  std::vector<std::int64_t> sizes_, counts_;
  std::int64_t width_ = -1, height_ = -1, points_ = -1;
  std::string_view data_;
  std::optional<Pose> viewpoint_;
  std::vector<Field> fields_;
  std::size_t point_bytes_ = 0;
  CloudBuilder cloud_;
};

}  // namespace

Expected<CloudFile> parse_pcd(std::string_view bytes, const std::string& name) {
  return PcdParser(bytes, name).parse();
}

}  // namespace canopeer
