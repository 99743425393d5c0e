#pragma once

#include <algorithm>
#include <bit>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/unordered_map.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cstring>
#include <deque>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"

// State as bytes (cereal, little-endian, the same on every machine). A class with state says what
// belongs to it in one place, for both directions:
//
//     template <typename Archive>
//     void serialize(Archive& archive) { archive(nodes_, edges_); }
//
// Heavy: for .cpp files only. The bytes hold no checksum; whoever writes them to a file adds one.

namespace canopeer {

/// The values one after the other.
template <typename... Values>
[[nodiscard]] std::string state_bytes(const Values&... values) {
  std::ostringstream out(std::ios::binary);
  {
    cereal::PortableBinaryOutputArchive archive(
        out, cereal::PortableBinaryOutputArchive::Options::LittleEndian());
    archive(values...);
  }
  return std::move(out).str();
}

class StateReader;

}  // namespace canopeer

namespace cereal::traits::detail {

/// Tells cereal which archive writes what StateReader reads.
template <>
struct get_output_from_input<canopeer::StateReader> {
  using type = cereal::PortableBinaryOutputArchive;
};

}  // namespace cereal::traits::detail

namespace canopeer {

/// What state_bytes() wrote, taken from where it lies. Any bytes may come: a length is believed as
/// far as there are bytes left, so memory is asked for in proportion to what was given.
class StateReader : public cereal::InputArchive<StateReader, cereal::AllowEmptyClassElision> {
 public:
  explicit StateReader(std::string_view bytes)
      : cereal::InputArchive<StateReader, cereal::AllowEmptyClassElision>(this), bytes_(bytes) {
    std::uint8_t is_little_endian = 0;
    take(&is_little_endian, 1, 1);
    if (is_little_endian != 1) throw cereal::Exception("it begins with another byte");
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

  /// Numbers of `width` bytes each, `size` bytes in all.
  void take(void* to, std::size_t size, std::size_t width) {
    if (size > bytes_.size()) throw cereal::Exception("it ends too early");
    if (size != 0) std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
    if constexpr (std::endian::native == std::endian::big) {
      auto* const first = static_cast<char*>(to);
      for (std::size_t i = 0; i < size; i += width) std::reverse(first + i, first + i + width);
    }
  }

 private:
  std::string_view bytes_;
};

template <typename Number>
requires std::is_arithmetic_v<Number>
void load(StateReader& reader, Number& number) {
  if constexpr (std::is_same_v<Number, bool>) {
    std::uint8_t byte = 0;
    reader.take(&byte, 1, 1);
    if (byte > 1) throw cereal::Exception("neither true nor false");
    number = byte == 1;
  } else {
    reader.take(&number, sizeof number, sizeof number);
  }
}

template <typename Number>
void load(StateReader& reader, cereal::BinaryData<Number>& numbers) {
  reader.take(numbers.data, static_cast<std::size_t>(numbers.size),
              sizeof(std::remove_pointer_t<Number>));
}

template <typename Value>
void load(StateReader& reader, cereal::NameValuePair<Value>& named) {
  reader(named.value);
}

template <typename Size>
void load(StateReader& reader, cereal::SizeTag<Size>& length) {
  reader(length.size);
  if (length.size > reader.left()) throw cereal::Exception("it ends too early");
}

/// Element by element, so that there are no more than have bytes of their own.
template <typename Values>
void load_one_by_one(StateReader& reader, Values& values) {
  cereal::size_type length = 0;
  reader(cereal::make_size_tag(length));
  values.clear();
  for (; length != 0; --length) reader(values.emplace_back());
}

template <typename Value>
requires(!std::is_arithmetic_v<Value>) void load(StateReader& reader, std::vector<Value>& values) {
  load_one_by_one(reader, values);
}

template <typename Value>
void load(StateReader& reader, std::deque<Value>& values) {
  load_one_by_one(reader, values);
}

/// Reads them back; the error says that the bytes end too early, hold more, or make no sense. The
/// values are then in no state to be used.
template <typename... Values>
[[nodiscard]] Expected<void> read_state_bytes(std::string_view bytes, Values&... values) {
  try {
    StateReader reader(bytes);
    reader(values...);
    if (reader.left() != 0) throw cereal::Exception("it holds more than was expected");
  } catch (const std::exception& error) {
    return fail(std::string("not a state of this version: ") + error.what());
  }
  return {};
}

}  // namespace canopeer

namespace Eigen {

/// Vectors and matrices: rows, columns, then the numbers column by column.
template <typename Archive, typename Scalar, int Rows, int Columns, int Options, int MaxRows,
          int MaxColumns>
void save(Archive& archive,
          const Matrix<Scalar, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
  archive(static_cast<std::int32_t>(matrix.rows()), static_cast<std::int32_t>(matrix.cols()));
  for (Index i = 0; i < matrix.size(); ++i) archive(matrix.data()[i]);
}
template <typename Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
void load(canopeer::StateReader& reader,
          Matrix<Scalar, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
  std::int32_t rows = 0;
  std::int32_t columns = 0;
  reader(rows, columns);
  const auto fits = [](std::int32_t size, int fixed, int most) {
    return size >= 0 && (fixed == Dynamic || size == fixed) && (most == Dynamic || size <= most);
  };
  if (!fits(rows, Rows, MaxRows) || !fits(columns, Columns, MaxColumns)) {
    throw cereal::Exception("a matrix of the wrong size");
  }
  if (std::uint64_t(rows) * std::uint64_t(columns) > reader.left()) {
    throw cereal::Exception("it ends too early");
  }
  matrix.resize(rows, columns);
  for (Index i = 0; i < matrix.size(); ++i) reader(matrix.data()[i]);
}

/// Poses as their matrix.
template <typename Archive>
void save(Archive& archive, const canopeer::Pose& pose) {
  archive(pose.matrix());
}
template <typename Archive>
void load(Archive& archive, canopeer::Pose& pose) {
  archive(pose.matrix());
}

template <typename Archive, typename Scalar, int Size>
void serialize(Archive& archive, AlignedBox<Scalar, Size>& box) {
  archive(box.min(), box.max());
}

}  // namespace Eigen
