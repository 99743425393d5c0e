#include "canopeer/import/meshes/texture_file.h"

#include <png.h>

#include <utility>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/meshes/picture_library.h"
#include "canopeer/sensing/jpeg.h"

namespace canopeer {
namespace {

Expected<Texture> decode_png(std::string_view bytes, const std::string& name) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return fail(name + ": " + png.message);
  }
  const bool alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format = PNG_FORMAT_RGBA;
  if (static_cast<std::size_t>(png.width) * png.height > kMostPicturePixels) {
    png_image_free(&png);
    return fail(name + ": the picture is too big");
  }
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0) {
    const std::string reason = png.message;
    png_image_free(&png);
    return fail(name + ": " + reason);
  }
  Texture texture;
  texture.name = name;
  texture.color = ColorImage(static_cast<int>(png.width), static_cast<int>(png.height));
  if (alpha) {
    texture.opacity =
        Image<std::uint8_t>(static_cast<int>(png.width), static_cast<int>(png.height));
  }
  for (std::size_t i = 0; i < texture.color.pixels().size(); ++i) {
    texture.color.pixels()[i] = {pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2]};
    if (alpha) texture.opacity.pixels()[i] = pixels[4 * i + 3];
  }
  return texture;
}

/// What is missing of one that was cut off is grey.
Expected<Texture> decode_jpeg(std::string_view bytes, const std::string& name) {
  auto color = parse_jpeg(bytes, {kMostPicturePixels, false});
  if (!color) return fail_in(name, color.error());
  Texture texture;
  texture.name = name;
  texture.color = std::move(*color);
  return texture;
}

Expected<Texture> decode_other(PictureKind kind, std::string_view bytes, const std::string& name) {
  const auto picture = read_picture(kind, bytes);
  if (!picture) return fail(name + ": " + picture.error().message);
  Texture texture;
  texture.name = name;
  texture.color = ColorImage(picture->width, picture->height);
  if (picture->alpha) {
    texture.opacity = Image<std::uint8_t>(picture->width, picture->height);
  }
  for (std::size_t i = 0; i < texture.color.pixels().size(); ++i) {
    const std::uint8_t* const pixel = picture->rgba.data() + 4 * i;
    texture.color.pixels()[i] = {pixel[0], pixel[1], pixel[2]};
    if (picture->alpha) texture.opacity.pixels()[i] = pixel[3];
  }
  return texture;
}

}  // namespace

Expected<Texture> decode_texture(std::string_view bytes, const std::string& name) {
  switch (const PictureKind kind = picture_kind(bytes)) {
    case PictureKind::png:
      return decode_png(bytes, name);
    case PictureKind::jpeg:
      return decode_jpeg(bytes, name);
    case PictureKind::unknown:
      return fail(name + ": " + picture_refusal(bytes));
    default:
      return decode_other(kind, bytes, name);
  }
}

Expected<std::string> encode_texture(const Texture& texture) {
  if (texture.color.empty()) return fail(texture.name + ": has no colours to write");
  const bool alpha = texture.opacity.width() == texture.color.width() &&
                     texture.opacity.height() == texture.color.height();
  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < texture.color.pixels().size(); ++i) {
    const Rgb& c = texture.color.pixels()[i];
    pixels.insert(pixels.end(), {c.r, c.g, c.b});
    if (alpha) pixels.push_back(texture.opacity.pixels()[i]);
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(texture.color.width());
  png.height = static_cast<png_uint_32>(texture.color.height());
  png.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    return fail(texture.name + ": cannot be written as PNG: " + png.message);
  }
  bytes.resize(size);
  return bytes;
}

TextureStore::Result TextureStore::get(const std::filesystem::path& path) {
  const std::string key = path.lexically_normal().string();
  if (const auto known = read_.find(key); known != read_.end()) return known->second;
  Result result = fail("");
  if (const auto bytes = read_file(path); !bytes) {
    result = tl::unexpected(bytes.error());
  } else if (auto texture = decode_texture(*bytes, path.string()); !texture) {
    result = tl::unexpected(texture.error());
  } else {
    result = std::make_shared<const Texture>(std::move(*texture));
  }
  return read_.emplace(key, std::move(result)).first->second;
}

}  // namespace canopeer
