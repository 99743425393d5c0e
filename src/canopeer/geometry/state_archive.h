#pragma once

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/unordered_map.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"

/// State as bytes (cereal, little-endian, the same on every machine). A class with state says what
/// belongs to it in one place, for both directions:
///
///     template <typename Archive>
///     void serialize(Archive& archive) { archive(nodes_, edges_); }
///
/// Heavy: for .cpp files only. The bytes hold no checksum; whoever writes them to a file adds one.

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

/// Reads them back; the error says that the bytes end too early, hold more, or make no sense. The
/// values are then in no state to be used.
template <typename... Values>
[[nodiscard]] Expected<void> read_state_bytes(std::string_view bytes, Values&... values) {
  std::istringstream in(std::string(bytes), std::ios::binary);
  try {
    cereal::PortableBinaryInputArchive archive(in);
    archive(values...);
  } catch (const std::exception& error) {
    return fail(std::string("not a state of this version: ") + error.what());
  }
  if (in.peek() != std::istringstream::traits_type::eof()) {
    return fail("not a state of this version: it holds more than was expected");
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
template <typename Archive, typename Scalar, int Rows, int Columns, int Options, int MaxRows,
          int MaxColumns>
void load(Archive& archive, Matrix<Scalar, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
  std::int32_t rows = 0;
  std::int32_t columns = 0;
  archive(rows, columns);
  const auto fits = [](std::int32_t size, int fixed, int most) {
    return size >= 0 && (fixed == Dynamic || size == fixed) && (most == Dynamic || size <= most);
  };
  if (!fits(rows, Rows, MaxRows) || !fits(columns, Columns, MaxColumns)) {
    throw cereal::Exception("a matrix of the wrong size");
  }
  matrix.resize(rows, columns);
  for (Index i = 0; i < matrix.size(); ++i) archive(matrix.data()[i]);
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
