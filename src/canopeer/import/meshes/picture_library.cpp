#include "canopeer/import/meshes/picture_library.h"

#include <stb/stb_image.h>
#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "canopeer/import/meshes/guarded_call.h"

namespace canopeer {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw std::runtime_error(reason); }

void check_size(int width, int height) {
  if (width <= 0 || height <= 0) refuse("the picture has no pixels");
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > kMostPicturePixels) {
    refuse("the picture is too big");
  }
}

/// A file in memory that knows whether more was asked of it than there is: stb makes something up
/// for pixels that are cut off.
struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  bool ran_out = false;

  static int read(void* self, char* to, int size) {
    auto& source = *static_cast<Source*>(self);
    const std::size_t asked = static_cast<std::size_t>(std::max(size, 0));
    const std::size_t got = std::min(asked, source.bytes.size() - source.at);
    std::memcpy(to, source.bytes.data() + source.at, got);
    source.at += got;
    // The library fills its buffer of 128 bytes as far as it goes, and asks for whole rows.
    source.ran_out = source.ran_out || (asked > 0 && got == 0) || (got < asked && asked != 128);
    return static_cast<int>(got);
  }
  static void skip(void* self, int count) {
    auto& source = *static_cast<Source*>(self);
    const auto left = static_cast<long long>(source.bytes.size() - source.at);
    source.ran_out = source.ran_out || count > left;
    const long long to = static_cast<long long>(source.at) + std::min<long long>(count, left);
    source.at = static_cast<std::size_t>(std::max(to, 0LL));
  }
  static int at_end(void* self) {
    const auto& source = *static_cast<Source*>(self);
    return source.at >= source.bytes.size() ? 1 : 0;
  }
};

constexpr stbi_io_callbacks kCallbacks = {Source::read, Source::skip, Source::at_end};

PlainPicture read_with_stb(std::string_view bytes) {
  PlainPicture picture;
  int channels = 0;
  Source head{bytes};
  if (stbi_info_from_callbacks(&kCallbacks, &head, &picture.width, &picture.height, &channels) ==
      0) {
    refuse(std::string("cannot be read: ") + stbi_failure_reason());
  }
  check_size(picture.width, picture.height);
  Source source{bytes};
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_callbacks(&kCallbacks, &source, &picture.width, &picture.height, &channels, 4),
      stbi_image_free);
  if (pixels == nullptr) refuse(std::string("cannot be read: ") + stbi_failure_reason());
  if (source.ran_out) refuse("is damaged: it is cut off");
  check_size(picture.width, picture.height);
  picture.alpha = channels == 2 || channels == 4;
  const auto count =
      4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  picture.rgba.assign(pixels.get(), pixels.get() + count);
  return picture;
}

PlainPicture read_webp(std::string_view bytes) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features{};
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) refuse("is damaged WebP");
  if (features.has_animation != 0)
    refuse("is an animated WebP; convert one of its pictures to PNG");
  check_size(features.width, features.height);
  PlainPicture picture{features.width, features.height, features.has_alpha != 0, {}};
  picture.rgba.resize(4 * static_cast<std::size_t>(picture.width) *
                      static_cast<std::size_t>(picture.height));
  if (WebPDecodeRGBAInto(data, bytes.size(), picture.rgba.data(), picture.rgba.size(),
                         4 * picture.width) == nullptr) {
    refuse("is damaged WebP");
  }
  return picture;
}

/// Many programs write a fourth channel of nothing but zeros, which means no opacity at all.
void drop_empty_alpha(PlainPicture* picture) {
  for (std::size_t i = 3; i < picture->rgba.size(); i += 4) {
    if (picture->rgba[i] != 0) return;
  }
  picture->alpha = false;
}

/// TGA may be written from right to left, which the library does not look at.
void mirror(PlainPicture* picture) {
  const auto width = static_cast<std::size_t>(picture->width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(picture->height); ++row) {
    std::uint8_t* const first = picture->rgba.data() + 4 * width * row;
    for (std::size_t x = 0; x < width / 2; ++x) {
      std::swap_ranges(first + 4 * x, first + 4 * (x + 1), first + 4 * (width - 1 - x));
    }
  }
}

PlainPicture decode(PictureKind kind, std::string_view bytes) {
  if (kind == PictureKind::webp) return read_webp(bytes);
  PlainPicture picture = read_with_stb(bytes);
  if (kind == PictureKind::tga && (bytes[17] & 0x10) != 0) mirror(&picture);
  if (kind == PictureKind::tga || kind == PictureKind::bmp) drop_empty_alpha(&picture);
  return picture;
}

std::string encode(const PlainPicture& picture) {
  const std::array<std::int32_t, 3> head = {picture.width, picture.height, picture.alpha ? 1 : 0};
  std::string bytes(reinterpret_cast<const char*>(head.data()), sizeof head);
  return bytes.append(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size());
}

Expected<PlainPicture> decoded(const std::string& bytes) {
  std::array<std::int32_t, 3> head{};
  if (bytes.size() < sizeof head) return fail("is damaged");
  std::memcpy(head.data(), bytes.data(), sizeof head);
  PlainPicture picture{head[0], head[1], head[2] != 0, {}};
  picture.rgba.assign(bytes.begin() + sizeof head, bytes.end());
  if (picture.width <= 0 || picture.height <= 0 ||
      picture.rgba.size() !=
          4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    return fail("is damaged");
  }
  return picture;
}

}  // namespace

Expected<PlainPicture> read_picture(PictureKind kind, std::string_view bytes) {
  const CallLimits limits{20.0, (64U << 20U) + 16 * kMostPicturePixels};
  const auto sent = guarded_call([&] { return encode(decode(kind, bytes)); }, limits);
  if (!sent) return tl::unexpected(sent.error());
  return decoded(*sent);
}

}  // namespace canopeer
