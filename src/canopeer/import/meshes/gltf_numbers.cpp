#include "canopeer/import/meshes/gltf_numbers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "canopeer/import/meshes/gltf_constants.h"

namespace canopeer {
namespace {

using nlohmann::json;

std::size_t bytes_of(int component) {
  if (component == gltf::kByte || component == gltf::kUnsignedByte) return 1;
  if (component == gltf::kShort || component == gltf::kUnsignedShort) return 2;
  if (component == gltf::kUnsignedInt || component == gltf::kFloat) return 4;
  throw std::runtime_error("glTF with numbers of no known kind");
}

std::size_t width_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' && type[3] <= '4') {
    return static_cast<std::size_t>(type[3] - '0');
  }
  return 0;
}

template <typename T>
double whole(const char* at, bool normalized) {
  T value{};
  std::memcpy(&value, at, sizeof value);
  const auto number = static_cast<double>(value);
  if (!normalized) return number;
  return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double number_at(const char* at, int component, bool normalized) {
  switch (component) {
    case gltf::kByte:
      return whole<std::int8_t>(at, normalized);
    case gltf::kUnsignedByte:
      return whole<std::uint8_t>(at, normalized);
    case gltf::kShort:
      return whole<std::int16_t>(at, normalized);
    case gltf::kUnsignedShort:
      return whole<std::uint16_t>(at, normalized);
    case gltf::kUnsignedInt:
      return whole<std::uint32_t>(at, normalized);
    default:
      break;
  }
  float value = 0.0F;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// A share of a buffer: `count` times `size` bytes, `stride` apart.
struct Rows {
  const char* first = nullptr;
  std::size_t stride = 0;
};

Rows rows_of(const json& file, const std::vector<std::string>& buffers, std::size_t view_index,
             std::size_t offset, std::size_t count, std::size_t size) {
  const json& view = file.at("bufferViews").at(view_index);
  const std::string& buffer = buffers.at(view.at("buffer").get<std::size_t>());
  const auto begin = view.value("byteOffset", std::size_t{0}) + offset;
  const auto stride = view.value("byteStride", size);
  const bool fits = begin <= buffer.size() && stride >= size && stride <= 252 + size &&
                    (count == 0 || (buffer.size() - begin >= size &&
                                    (buffer.size() - begin - size) / stride >= count - 1));
  if (!fits) throw std::runtime_error("glTF with numbers beyond the end of its buffer");
  return {buffer.data() + begin, stride};
}

void fill_in(const json& file, const std::vector<std::string>& buffers, const json& accessor,
             std::size_t width, std::vector<float>* numbers) {
  const json& sparse = accessor.at("sparse");
  const auto count = sparse.at("count").get<std::size_t>();
  const int component = accessor.at("componentType").get<int>();
  const bool normalized = accessor.value("normalized", false);
  const json& places = sparse.at("indices");
  const json& values = sparse.at("values");
  const int place_type = places.at("componentType").get<int>();
  const std::size_t size = bytes_of(component);
  const Rows where =
      rows_of(file, buffers, places.at("bufferView").get<std::size_t>(),
              places.value("byteOffset", std::size_t{0}), count, bytes_of(place_type));
  const Rows what = rows_of(file, buffers, values.at("bufferView").get<std::size_t>(),
                            values.value("byteOffset", std::size_t{0}), count, size * width);
  for (std::size_t i = 0; i < count; ++i) {
    const double place = number_at(where.first + i * where.stride, place_type, false);
    if (!(place >= 0.0 && place < static_cast<double>(numbers->size() / width))) {
      throw std::runtime_error("glTF with sparse numbers beyond the end");
    }
    const auto row = static_cast<std::size_t>(place);
    for (std::size_t k = 0; k < width; ++k) {
      (*numbers)[row * width + k] = static_cast<float>(
          number_at(what.first + i * what.stride + k * size, component, normalized));
    }
  }
}

}  // namespace

std::vector<float> gltf_numbers(const json& file, const std::vector<std::string>& buffers,
                                std::size_t accessor_index, std::size_t width) {
  const json& accessor = file.at("accessors").at(accessor_index);
  const auto count = accessor.at("count").get<std::size_t>();
  const int component = accessor.at("componentType").get<int>();
  const bool normalized = accessor.value("normalized", false);
  if (width_of(accessor.at("type").get<std::string>()) != width) {
    throw std::runtime_error("glTF with vectors of the wrong length");
  }
  const std::size_t size = bytes_of(component);
  if (count > (std::size_t{1} << 28U)) throw std::runtime_error("glTF with too many numbers");
  std::vector<float> numbers(count * width, 0.0F);
  if (accessor.contains("bufferView")) {
    const Rows rows = rows_of(file, buffers, accessor.at("bufferView").get<std::size_t>(),
                              accessor.value("byteOffset", std::size_t{0}), count, size * width);
    for (std::size_t i = 0; i < count * width; ++i) {
      const char* const at = rows.first + i / width * rows.stride + i % width * size;
      numbers[i] = static_cast<float>(number_at(at, component, normalized));
    }
  }
  if (accessor.contains("sparse")) fill_in(file, buffers, accessor, width, &numbers);
  return numbers;
}

}  // namespace canopeer
