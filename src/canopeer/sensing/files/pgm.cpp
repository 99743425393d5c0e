#include "canopeer/sensing/files/pgm.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "canopeer/base/byte_order.h"

namespace canopeer {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Walks through whole numbers between blanks and comments.
class PgmNumbers {
 public:
  explicit PgmNumbers(std::string_view bytes) : bytes_(bytes) {}

  /// Nothing: no number is there, or it is above `limit`.
  std::optional<std::uint32_t> next(std::uint32_t limit) {
    skip_blanks();
    const std::size_t begin = at_;
    std::uint64_t value = 0;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
      value = value * 10 + static_cast<std::uint64_t>(bytes_[at_] - '0');
      if (value > limit) return std::nullopt;
    }
    if (at_ == begin) return std::nullopt;
    return static_cast<std::uint32_t>(value);
  }
  /// What follows the one blank after the header.
  [[nodiscard]] std::string_view raster() const {
    return at_ < bytes_.size() ? bytes_.substr(at_ + 1) : std::string_view();
  }

 private:
  void skip_blanks() {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') at_ = std::min(bytes_.find('\n', at_), bytes_.size() - 1);
      ++at_;
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 2;
};

}  // namespace

bool is_pgm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '2') &&
         is_space(bytes[2]);
}

// The format: https://netpbm.sourceforge.net/doc/pgm.html
Expected<Image<std::uint16_t>> parse_pgm16(std::string_view bytes) {
  if (!is_pgm(bytes)) return fail("not a PGM file");
  constexpr std::uint32_t kMaxSide = 1 << 20;
  PgmNumbers numbers(bytes);
  const auto width = numbers.next(kMaxSide);
  const auto height = numbers.next(kMaxSide);
  const auto largest = numbers.next(65535);
  if (!width || !height || !largest || *width == 0 || *height == 0 || *largest == 0) {
    return fail("the PGM header is damaged: expected width, height and the largest value");
  }
  if (*largest <= 255) return fail("not a depth image: expected 16 bit grey, got 8 bit grey");
  const bool text = bytes[1] == '2';
  const std::size_t count = std::size_t{*width} * *height;
  const std::string_view raster = numbers.raster();
  if (raster.size() / (text ? 1 : 2) < (text ? 2 * count - 1 : count)) {
    return fail("the PGM file was cut off");
  }
  Image<std::uint16_t> image(static_cast<int>(*width), static_cast<int>(*height));
  for (std::size_t i = 0; i < count; ++i) {
    if (!text) {
      image.pixels()[i] = load_number<std::uint16_t>(raster.data() + 2 * i, ByteOrder::big);
      continue;
    }
    const auto value = numbers.next(65535);
    if (!value) return fail("pixel " + std::to_string(i + 1) + " of the PGM file is no number");
    image.pixels()[i] = static_cast<std::uint16_t>(*value);
  }
  return image;
}

}  // namespace canopeer
