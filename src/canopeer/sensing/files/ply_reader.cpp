#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/point_columns.h"

namespace canopeer {
namespace {

struct Property {
  NumberType type = NumberType::f32;
  std::optional<NumberType> list_count;  // set: a list, this is the type of its length
  std::optional<Column> column;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;

  // Bytes of a binary row; nothing when lists make rows differ.
  [[nodiscard]] std::optional<std::size_t> fixed_size() const {
    std::size_t size = 0;
    for (const Property& property : properties) {
      if (property.list_count) return std::nullopt;
      size += size_of(property.type);
    }
    return size;
  }
};

enum class Format { ascii, binary_little, binary_big };

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

std::optional<NumberType> type_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, NumberType>, 16> kNames = {
      {{"char", NumberType::i8},
       {"int8", NumberType::i8},
       {"uchar", NumberType::u8},
       {"uint8", NumberType::u8},
       {"short", NumberType::i16},
       {"int16", NumberType::i16},
       {"ushort", NumberType::u16},
       {"uint16", NumberType::u16},
       {"int", NumberType::i32},
       {"int32", NumberType::i32},
       {"uint", NumberType::u32},
       {"uint32", NumberType::u32},
       {"float", NumberType::f32},
       {"float32", NumberType::f32},
       {"double", NumberType::f64},
       {"float64", NumberType::f64}}};
  for (const auto& [known, type] : kNames) {
    if (name == known) return type;
  }
  return std::nullopt;
}

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  Expected<CloudFile> parse() {
    const auto header = read_header();
    if (!header) return tl::unexpected(header.error());
    format_ = header->format;
    rest_ = lines_.rest();
    for (const Element& element : header->elements) {
      const bool vertices = element.name == "vertex";
      if (const auto done = vertices ? read_vertices(element) : pass_over(element); !done) {
        return tl::unexpected(done.error());
      }
      if (vertices) return cloud_.take();
    }
    return fail(name_ + ": has no element \"vertex\"");
  }

 private:
  tl::unexpected<Error> fail_here(const std::string& message) const {
    return fail(name_ + ":" + std::to_string(lines_.number()) + ": " + message);
  }

  Expected<Header> read_header() {
    if (lines_.next() != "ply") {
      return fail(name_ + ": not a PLY file (the first line must be \"ply\")");
    }
    Header header;
    bool format_known = false;
    while (const auto line = lines_.next()) {
      const auto words = words_of(*line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        if (!format_known) return fail_here("the header has no line \"format …\"");
        return header;
      }
      Expected<void> done = fail_here("unknown line \"" + std::string(words[0]) +
                                      " …\"; expected format, element, property or end_header");
      if (words[0] == "format") {
        done = read_format(words, header);
        format_known = true;
      } else if (words[0] == "element") {
        done = read_element(words, header);
      } else if (words[0] == "property") {
        done = read_property(words, header);
      }
      if (!done) return tl::unexpected(done.error());
    }
    return fail(name_ + ": the header has no line \"end_header\": the file was cut off");
  }

  using Words = std::vector<std::string_view>;

  Expected<void> read_format(const Words& words, Header& header) {
    const std::string_view format = words.size() > 1 ? words[1] : "";
    if (format == "ascii") {
      header.format = Format::ascii;
    } else if (format == "binary_little_endian") {
      header.format = Format::binary_little;
    } else if (format == "binary_big_endian") {
      header.format = Format::binary_big;
    } else {
      return fail_here(
          "expected \"format ascii 1.0\", \"format binary_little_endian 1.0\" or \"format "
          "binary_big_endian 1.0\"");
    }
    return {};
  }

  Expected<void> read_element(const Words& words, Header& header) {
    const auto count = words.size() == 3 ? to_integer(words[2]) : std::nullopt;
    if (!count || *count < 0) return fail_here("expected \"element NAME COUNT\"");
    header.elements.push_back({std::string(words[1]), *count, {}});
    return {};
  }

  Expected<void> read_property(const Words& words, Header& header) {
    if (header.elements.empty()) return fail_here("a property before the first element");
    const bool list = words.size() == 5 && words[1] == "list";
    const auto count_type = list ? type_named(words[2]) : std::nullopt;
    const auto type =
        list ? type_named(words[3]) : (words.size() == 3 ? type_named(words[1]) : std::nullopt);
    if (!type || (list && !count_type)) {
      return fail_here(
          "expected \"property TYPE NAME\" or \"property list TYPE TYPE NAME\" with a type such as "
          "float or uchar");
    }
    Property property{*type, count_type, std::nullopt};
    if (!list && header.elements.back().name == "vertex") {
      property.column = column_named(words.back());
      if (property.column) cloud_.declare(*property.column, *type);
    }
    header.elements.back().properties.push_back(property);
    return {};
  }

  Expected<void> read_vertices(const Element& element) {
    if (!cloud_.has_position()) {
      return fail(name_ + ": the element \"vertex\" has no properties x, y and z");
    }
    cloud_.reserve(
        std::min<std::size_t>(static_cast<std::size_t>(element.count), rest_.size() / 3));
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (const auto done = read_row(element, i); !done) return done;
      cloud_.finish_point();
    }
    return {};
  }

  // An element before the vertices.
  Expected<void> pass_over(const Element& element) {
    if (element.properties.empty()) return {};
    const auto size = element.fixed_size();
    if (format_ != Format::ascii && size) {
      if (static_cast<std::size_t>(element.count) > rest_.size() / *size) {
        return cut_off(element, static_cast<std::int64_t>(rest_.size() / *size));
      }
      rest_.remove_prefix(static_cast<std::size_t>(element.count) * *size);
      return {};
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (const auto done = read_row(element, i); !done) return done;
    }
    return {};
  }

  Expected<void> read_row(const Element& element, std::int64_t i) {
    return format_ == Format::ascii ? read_text_row(element, i) : read_binary_row(element, i);
  }

  tl::unexpected<Error> cut_off(const Element& element, std::int64_t i) const {
    return fail(name_ + ": ends within " + element.name + " " + std::to_string(i + 1) + " of " +
                std::to_string(element.count) + ": the file was cut off");
  }

  Expected<void> read_text_row(const Element& element, std::int64_t i) {
    const auto line = lines_.next();
    if (!line) return cut_off(element, i);
    const auto words = words_of(*line);
    std::size_t at = 0;
    for (const Property& property : element.properties) {
      if (property.list_count) {
        const auto length = at < words.size() ? to_integer(words[at]) : std::nullopt;
        const auto left = static_cast<std::int64_t>(words.size() - at) - 1;
        if (!length || *length < 0 || *length > left) return fail_here("a list is malformed");
        at += static_cast<std::size_t>(*length) + 1;
        continue;
      }
      const auto value = at < words.size() ? to_number(words[at]) : std::nullopt;
      if (!value) return wrong_numbers(element);
      if (property.column) set(property, *value);
      ++at;
    }
    if (at != words.size()) return wrong_numbers(element);
    return {};
  }

  tl::unexpected<Error> wrong_numbers(const Element& element) const {
    return fail_here("expected a line of " + std::to_string(element.properties.size()) +
                     " numbers for each " + element.name);
  }

  Expected<void> read_binary_row(const Element& element, std::int64_t i) {
    const ByteOrder order = format_ == Format::binary_big ? ByteOrder::big : ByteOrder::little;
    for (const Property& property : element.properties) {
      std::size_t bytes = size_of(property.type);
      if (property.list_count) {
        const std::size_t count_bytes = size_of(*property.list_count);
        if (rest_.size() < count_bytes) return cut_off(element, i);
        const double length = load_as_double(*property.list_count, rest_.data(), order);
        rest_.remove_prefix(count_bytes);
        if (!(length >= 0.0 &&
              length <= static_cast<double>(rest_.size()) / static_cast<double>(bytes))) {
          return cut_off(element, i);
        }
        bytes *= static_cast<std::size_t>(length);
      }
      if (rest_.size() < bytes) return cut_off(element, i);
      if (property.column) set(property, load_as_double(property.type, rest_.data(), order));
      rest_.remove_prefix(bytes);
    }
    return {};
  }

  void set(const Property& property, double value) {
    if (property.column == Column::rgb) {
      cloud_.set_packed_rgb(property.type, value);
    } else {
      cloud_.set(*property.column, value);
    }
  }

  TextLines lines_;
  const std::string& name_;
  std::string_view rest_;  // of binary rows
  Format format_ = Format::ascii;
  CloudBuilder cloud_;
};

}  // namespace

Expected<CloudFile> parse_ply(std::string_view bytes, const std::string& name) {
  return PlyParser(bytes, name).parse();
}

}  // namespace canopeer
