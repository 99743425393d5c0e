#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "canopeer/base/byte_order.h"
#include "canopeer/sensing/cloud_file.h"

namespace canopeer {

/// How a number of a point is stored.
enum class NumberType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

[[nodiscard]] std::size_t size_of(NumberType type);
[[nodiscard]] bool is_real(NumberType type);
[[nodiscard]] double load_as_double(NumberType type, const char* bytes, ByteOrder order);

/// What a column of a cloud file means to us.
enum class Column : std::uint8_t { x, y, z, nx, ny, nz, red, green, blue, rgb, roi, fruit };
inline constexpr std::size_t kColumns = 12;

/// By the names that writers of clouds use, in small letters or capitals; nothing for columns that
/// are passed over.
[[nodiscard]] std::optional<Column> column_named(std::string_view name);

/// Puts a cloud together from rows of numbers.
class CloudBuilder {
 public:
  /// The file has such a column.
  void declare(Column column, NumberType type);
  [[nodiscard]] bool has(Column column) const { return present_[index(column)]; }
  [[nodiscard]] bool has_position() const;
  void reserve(std::size_t points);

  void set(Column column, double value) { row_[index(column)] = value; }
  /// Colour packed into 32 bits, blue in the lowest byte.
  void set_packed_rgb(std::uint32_t bits);
  /// The same from a number of the file: a real one holds the bits of a float.
  void set_packed_rgb(NumberType type, double value);
  /// The row set is a point.
  void finish_point();
  /// All points. Colours that are not bytes go from 0 to 1, 255 or 65535, as the largest tells.
  [[nodiscard]] CloudFile take();

 private:
  static constexpr std::size_t index(Column column) { return static_cast<std::size_t>(column); }
  [[nodiscard]] Eigen::Vector3f vector(Column first) const;
  [[nodiscard]] double color_scale() const;

  std::array<bool, kColumns> present_{};
  std::array<NumberType, kColumns> types_{};
  std::array<double, kColumns> row_{};
  bool wide_colors_ = false;
  std::vector<Eigen::Vector3f> wide_;  // colours as they stand in the file
  CloudFile file_;
};

}  // namespace canopeer
