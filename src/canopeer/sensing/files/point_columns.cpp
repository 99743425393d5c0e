#include "canopeer/sensing/files/point_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace canopeer {

namespace {

std::uint8_t byte_of(double value) {
  if (!(value > 0.0)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::fmin(value, 255.0)));
}

}  // namespace

std::size_t size_of(NumberType type) {
  constexpr std::array<std::uint8_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_real(NumberType type) { return type == NumberType::f32 || type == NumberType::f64; }

double load_as_double(NumberType type, const char* bytes, ByteOrder order) {
  switch (type) {
    case NumberType::i8:
      return load_number<std::int8_t>(bytes, order);
    case NumberType::u8:
      return load_number<std::uint8_t>(bytes, order);
    case NumberType::i16:
      return load_number<std::int16_t>(bytes, order);
    case NumberType::u16:
      return load_number<std::uint16_t>(bytes, order);
    case NumberType::i32:
      return load_number<std::int32_t>(bytes, order);
    case NumberType::u32:
      return load_number<std::uint32_t>(bytes, order);
    case NumberType::i64:
      return static_cast<double>(load_number<std::int64_t>(bytes, order));
    case NumberType::u64:
      return static_cast<double>(load_number<std::uint64_t>(bytes, order));
    case NumberType::f32:
      return static_cast<double>(load_number<float>(bytes, order));
    case NumberType::f64:
      return load_number<double>(bytes, order);
  }
  return 0.0;
}

std::optional<Column> column_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Column>, 40> kNames = {
      {{"x", Column::x},
       {"y", Column::y},
       {"z", Column::z},
       {"points:0", Column::x},  // ParaView
       {"points:1", Column::y},
       {"points:2", Column::z},
       {"points_0", Column::x},
       {"points_1", Column::y},
       {"points_2", Column::z},
       {"nx", Column::nx},
       {"ny", Column::ny},
       {"nz", Column::nz},
       {"normal_x", Column::nx},
       {"normal_y", Column::ny},
       {"normal_z", Column::nz},
       {"normalx", Column::nx},
       {"normaly", Column::ny},
       {"normalz", Column::nz},
       {"normals:0", Column::nx},
       {"normals:1", Column::ny},
       {"normals:2", Column::nz},
       {"red", Column::red},
       {"green", Column::green},
       {"blue", Column::blue},
       {"r", Column::red},
       {"g", Column::green},
       {"b", Column::blue},
       {"rf", Column::red},  // CloudCompare, 0 … 1
       {"gf", Column::green},
       {"bf", Column::blue},
       {"diffuse_red", Column::red},
       {"diffuse_green", Column::green},
       {"diffuse_blue", Column::blue},
       {"rgb:0", Column::red},
       {"rgb:1", Column::green},
       {"rgb:2", Column::blue},
       {"rgb", Column::rgb},
       {"rgba", Column::rgb},
       {"roi", Column::roi},
       {"fruit", Column::fruit}}};
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  for (const auto& [known, column] : kNames) {
    if (std::equal(name.begin(), name.end(), known.begin(), known.end(),
                   [&](char a, char b) { return lower(a) == b; })) {
      return column;
    }
  }
  return std::nullopt;
}

void CloudBuilder::declare(Column column, NumberType type) {
  present_[index(column)] = true;
  types_[index(column)] = type;
  if (column == Column::red) wide_colors_ = type != NumberType::u8;
  if (column != Column::rgb) return;
  for (const Column channel : {Column::red, Column::green, Column::blue}) {
    declare(channel, NumberType::u8);
  }
}

bool CloudBuilder::has_position() const {
  return has(Column::x) && has(Column::y) && has(Column::z);
}

void CloudBuilder::set_packed_rgb(NumberType type, double value) {
  if (is_real(type)) {  // 32 bits that were written as if they were a float
    const auto real = static_cast<float>(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &real, sizeof bits);
    set_packed_rgb(bits);
  } else if (value >= 0.0 && value <= 4294967295.0) {
    set_packed_rgb(static_cast<std::uint32_t>(value));
  }
}

void CloudBuilder::reserve(std::size_t points) {
  file_.cloud.points.reserve(points);
  if (has(Column::nx)) file_.cloud.normals.reserve(points);
  if (has(Column::red)) file_.cloud.colors.reserve(points);
  if (has(Column::roi)) file_.roi_confidence.reserve(points);
  if (has(Column::fruit)) file_.fruit.reserve(points);
}

void CloudBuilder::set_packed_rgb(std::uint32_t bits) {
  set(Column::red, bits >> 16 & 0xFF);
  set(Column::green, bits >> 8 & 0xFF);
  set(Column::blue, bits & 0xFF);
}

void CloudBuilder::finish_point() {
  file_.cloud.points.push_back(vector(Column::x));
  if (has(Column::nx) && has(Column::ny) && has(Column::nz)) {
    file_.cloud.normals.push_back(vector(Column::nx));
  }
  if (has(Column::red) && has(Column::green) && has(Column::blue)) {
    const std::size_t first = index(Column::red);
    file_.cloud.colors.push_back(
        {byte_of(row_[first]), byte_of(row_[first + 1]), byte_of(row_[first + 2])});
    if (wide_colors_) wide_.push_back(vector(Column::red));
  }
  if (has(Column::roi)) {
    const double roi = row_[index(Column::roi)];
    const bool real = is_real(types_[index(Column::roi)]);
    file_.roi_confidence.push_back(static_cast<float>(real ? roi : roi != 0.0 ? 1.0 : 0.0));
  }
  if (has(Column::fruit)) {
    const double fruit = row_[index(Column::fruit)];
    const bool number = fruit >= 0.0 && fruit < 2147483647.0;
    file_.fruit.push_back(number ? static_cast<int>(fruit) : -1);
  }
}

Eigen::Vector3f CloudBuilder::vector(Column first) const {
  const std::size_t i = index(first);
  return Vec3(row_[i], row_[i + 1], row_[i + 2]).cast<float>();
}

CloudFile CloudBuilder::take() {
  if (!wide_.empty()) {
    const double scale = color_scale();
    for (std::size_t i = 0; i < wide_.size(); ++i) {
      const Eigen::Vector3d c = scale * wide_[i].cast<double>();
      file_.cloud.colors[i] = {byte_of(c[0]), byte_of(c[1]), byte_of(c[2])};
    }
    wide_.clear();
  }
  return std::move(file_);
}

// No type says how far colours go. A cloud in which none exceeds 2 of 255 is black: then they go
// to 1.
double CloudBuilder::color_scale() const {
  float largest = 0.0F;
  for (const Eigen::Vector3f& c : wide_) {
    for (const float value : c)
      largest = std::isfinite(value) ? std::fmax(largest, value) : largest;
  }
  const bool real = is_real(types_[index(Column::red)]);
  if (real && largest <= 2.0F) return 255.0;
  return largest > 255.0F ? 255.0 / 65535.0 : 1.0;
}

}  // namespace canopeer
