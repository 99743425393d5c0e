#include <gtest/gtest.h>
#include <webp/encode.h>

#include "canopeer/base/rng.h"
#include "canopeer/import/meshes/texture_file.h"

namespace canopeer {
namespace {

using Bytes = std::string;

Bytes word(int value) { return {static_cast<char>(value & 255), static_cast<char>(value >> 8)}; }
Bytes long_word(int value) { return word(value & 0xffff) + word(value >> 16); }
Bytes big_word(int value) {
  return {static_cast<char>(value >> 8), static_cast<char>(value & 255)};
}

// Red, green over blue, white; red and blue as the formats have them: blue first.
const Bytes kRed("\x00\x00\xff", 3);
const Bytes kGreen("\x00\xff\x00", 3);
const Bytes kBlue("\xff\x00\x00", 3);
const Bytes kWhite("\xff\xff\xff", 3);

Bytes tga_header(int kind, int width, int height, int bits, int descriptor) {
  return Bytes(2, '\0') + static_cast<char>(kind) + Bytes(9, '\0') + word(width) + word(height) +
         static_cast<char>(bits) + static_cast<char>(descriptor);
}

Bytes with_alpha(const Bytes& color, int alpha) { return color + static_cast<char>(alpha); }

void expect_four_pixels(const Bytes& bytes, const char* what) {
  const auto texture = decode_texture(bytes, what);
  ASSERT_TRUE(texture.has_value()) << texture.error().message;
  ASSERT_EQ(texture->color.width(), 2) << what;
  ASSERT_EQ(texture->color.height(), 2) << what;
  EXPECT_EQ(texture->color.at(0, 0), (Rgb{255, 0, 0})) << what;
  EXPECT_EQ(texture->color.at(1, 0), (Rgb{0, 255, 0})) << what;
  EXPECT_EQ(texture->color.at(0, 1), (Rgb{0, 0, 255})) << what;
  EXPECT_EQ(texture->color.at(1, 1), (Rgb{255, 255, 255})) << what;
}

Bytes bottom_up_tga() { return tga_header(2, 2, 2, 24, 0) + kBlue + kWhite + kRed + kGreen; }

Bytes bmp() {
  const Bytes pixels = kBlue + kWhite + word(0) + kRed + kGreen + word(0);  // rows of 4 n bytes
  return "BM" + long_word(54 + 16) + long_word(0) + long_word(54) + long_word(40) + long_word(2) +
         long_word(2) + word(1) + word(24) + Bytes(24, '\0') + pixels;
}

Bytes psd() {
  return "8BPS" + big_word(1) + Bytes(6, '\0') + big_word(3) + big_word(0) + big_word(2) +
         big_word(0) + big_word(2) + big_word(8) + big_word(3) + Bytes(12, '\0') + big_word(0) +
         Bytes("\xff\x00\x00\xff", 4) + Bytes("\x00\xff\x00\xff", 4) + Bytes("\x00\x00\xff\xff", 4);
}

/// Four colours, codes of three bits: clear, 0, 1, 2, 3, end.
Bytes gif() {
  return "GIF89a" + word(2) + word(2) + Bytes("\xf1\x00\x00", 3) +
         Bytes("\xff\x00\x00\x00\xff\x00\x00\x00\xff\xff\xff\xff", 12) + "," + word(0) + word(0) +
         word(2) + word(2) + Bytes("\x00\x02\x03\x44\x34\x05\x00;", 8);
}

TEST(Picture, TgaIsReadInAllItsManners) {
  expect_four_pixels(bottom_up_tga(), "bottom up");
  expect_four_pixels(tga_header(2, 2, 2, 24, 0x20) + kRed + kGreen + kBlue + kWhite, "top down");
  expect_four_pixels(tga_header(2, 2, 2, 24, 0x30) + kGreen + kRed + kWhite + kBlue,
                     "from right to left");
  const char one = '\0';  // a packet of one pixel
  expect_four_pixels(
      tga_header(10, 2, 2, 24, 0x20) + one + kRed + one + kGreen + '\x01' + kBlue + kWhite,
      "in runs");
  const Bytes palette = kRed + kGreen + kBlue + kWhite;
  expect_four_pixels(Bytes("\x00\x01\x01\x00\x00\x04\x00\x18", 8) + Bytes(4, '\0') + word(2) +
                         word(2) + "\x08\x20" + palette + Bytes("\x00\x01\x02\x03", 4),
                     "with a palette");
}

TEST(Picture, TheAlphaOfATgaCutsUnlessAllOfItIsEmpty) {
  const auto picture = [](int alpha_of_white, int alpha) {
    return decode_texture(tga_header(2, 2, 2, 32, 0x28) + with_alpha(kRed, alpha) +
                              with_alpha(kGreen, alpha) + with_alpha(kBlue, alpha) +
                              with_alpha(kWhite, alpha_of_white),
                          "leaf.tga");
  };
  const auto leaf = picture(0, 255);
  ASSERT_TRUE(leaf.has_value()) << leaf.error().message;
  EXPECT_TRUE(leaf->cuts());
  EXPECT_EQ(leaf->opacity.at(1, 1), 0);
  EXPECT_EQ(leaf->opacity.at(0, 0), 255);
  const auto empty = picture(0, 0);
  ASSERT_TRUE(empty.has_value());
  EXPECT_FALSE(empty->cuts());
}

TEST(Picture, BmpPsdAndGifAreRead) {
  expect_four_pixels(bmp(), "bmp");
  expect_four_pixels(psd(), "psd");
  expect_four_pixels(gif(), "gif");
}

TEST(Picture, WebpIsRead) {
  const std::array<std::uint8_t, 12> pixels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  std::uint8_t* out = nullptr;
  const std::size_t size = WebPEncodeLosslessRGB(pixels.data(), 2, 2, 6, &out);
  const Bytes webp(reinterpret_cast<const char*>(out), size);
  WebPFree(out);
  expect_four_pixels(webp, "webp");
  const auto cut = decode_texture(webp.substr(0, size / 2), "cut.webp");
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().message, "cut.webp: is damaged WebP");
}

TEST(Picture, WhatIsCutOffIsAnError) {
  for (const Bytes& whole :
       {bottom_up_tga(), bmp(), psd(), tga_header(10, 2, 2, 24, 0x20) + '\x83' + kRed}) {
    const auto texture = decode_texture(whole.substr(0, whole.size() - 2), "cut");
    ASSERT_FALSE(texture.has_value());
    EXPECT_EQ(texture.error().message, "cut: is damaged: it is cut off");
  }
}

TEST(Picture, BombsAreTooBig) {
  for (const Bytes& bomb :
       {tga_header(2, 65535, 65535, 24, 0), tga_header(10, 65535, 65535, 32, 0)}) {
    const auto texture = decode_texture(bomb, "bomb.tga");
    ASSERT_FALSE(texture.has_value());
    EXPECT_EQ(texture.error().message, "bomb.tga: the picture is too big");
  }
}

TEST(Picture, DamagedOnesAreReadOrRefused) {
  Rng rng(1, "damaged pictures");
  for (const Bytes& good : {bottom_up_tga(), bmp(), psd(), gif()}) {
    for (int i = 0; i < 30; ++i) {
      Bytes bad = good;
      for (int k = 0; k < 3; ++k) {
        const std::size_t at = rng.index(bad.size());
        // A header that promises a huge picture is no news and takes its time.
        if (at < 12 || at > 26) bad[at] = static_cast<char>(rng.index(256));
      }
      const auto texture = decode_texture(bad, "bad.pic");
      if (!texture) {
        EXPECT_EQ(texture.error().message.find("bad.pic: "), 0U);
      }
    }
  }
}

TEST(Picture, OtherKindsAreNamedWithWhatToDo) {
  const auto message = [](const Bytes& bytes) {
    const auto texture = decode_texture(bytes, "leaf.tga");
    return texture.has_value() ? std::string() : texture.error().message;
  };
  EXPECT_NE(
      message("DDS |").find("leaf.tga: is a DDS texture, which is not read; convert it to PNG"),
      std::string::npos);
  EXPECT_NE(message("\xabKTX 20\xbb\r\n").find("is a KTX2 texture"), std::string::npos);
  EXPECT_NE(message("version https://git-lfs.github.com/spec/v1\n").find("Git LFS pointer"),
            std::string::npos);
  EXPECT_NE(message("<!DOCTYPE html>").find("is a web page"), std::string::npos);
  EXPECT_NE(message("").find("is empty"), std::string::npos);
  EXPECT_NE(message("nonsense of some length").find("expected a picture: PNG"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
