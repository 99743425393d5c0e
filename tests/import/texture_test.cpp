#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "canopeer/import/meshes/texture_file.h"

namespace canopeer {
namespace {

/// 2 × 2 pixels: red, green over blue, white; the white one is a hole.
Texture four_pixels() {
  Texture texture;
  texture.name = "four.png";
  texture.color = ColorImage(2, 2);
  texture.color.at(0, 0) = {255, 0, 0};
  texture.color.at(1, 0) = {0, 255, 0};
  texture.color.at(0, 1) = {0, 0, 255};
  texture.color.at(1, 1) = {255, 255, 255};
  texture.opacity = Image<std::uint8_t>(2, 2, 255);
  texture.opacity.at(1, 1) = 0;
  return texture;
}

TEST(Texture, CoordinatesBeginAtTheLowerLeftAndRepeat) {
  const Texture texture = four_pixels();
  for (const float shift : {0.0F, 1.0F, -3.0F}) {
    const auto at = [&](float u, float v) {
      return texture.color_at(Eigen::Vector2f(u + shift, v + shift));
    };
    EXPECT_EQ(at(0.2F, 0.8F), Eigen::Vector3f(255, 0, 0));
    EXPECT_EQ(at(0.2F, 0.2F), Eigen::Vector3f(0, 0, 255));
    EXPECT_EQ(at(0.8F, 0.8F), Eigen::Vector3f(0, 255, 0));
    EXPECT_FALSE(texture.solid_at(Eigen::Vector2f(0.8F + shift, 0.2F + shift)));
    EXPECT_TRUE(texture.solid_at(Eigen::Vector2f(0.2F + shift, 0.2F + shift)));
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(texture.color_at(Eigen::Vector2f(nan, nan)).allFinite());
  EXPECT_TRUE(texture.cuts());
}

TEST(Texture, APngKeepsColoursAndAlpha) {
  const auto bytes = encode_texture(four_pixels());
  ASSERT_TRUE(bytes.has_value());
  const auto back = decode_texture(*bytes, "four.png");
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_TRUE(back->color.pixels() == four_pixels().color.pixels());
  EXPECT_TRUE(back->opacity.pixels() == four_pixels().opacity.pixels());
  Texture opaque = four_pixels();
  opaque.opacity = {};
  const auto again = decode_texture(*encode_texture(opaque), "four.png");
  ASSERT_TRUE(again.has_value());
  EXPECT_FALSE(again->cuts());
}

/// A grey JPEG of 8 × 8 pixels, all the same, by hand: one block with nothing but its mean.
std::string grey_jpeg() {
  std::string jpeg = "\xff\xd8";
  jpeg += std::string("\xff\xdb\x00\x43\x00", 5) + std::string(64, '\x01');
  jpeg += std::string("\xff\xc0\x00\x0b\x08\x00\x08\x00\x08\x01\x01\x11\x00", 13);
  // One DC code (category 0) and one AC code (end of block), each of one bit.
  jpeg += std::string("\xff\xc4\x00\x14\x00\x01", 6) + std::string(15, '\0') + std::string(1, '\0');
  jpeg += std::string("\xff\xc4\x00\x14\x10\x01", 6) + std::string(15, '\0') + std::string(1, '\0');
  jpeg += std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10);
  jpeg += "\x3f";  // code 0, code 0, filled up with ones
  jpeg += "\xff\xd9";
  return jpeg;
}

TEST(Texture, AJpegIsRead) {
  const auto texture = decode_texture(grey_jpeg(), "grey.jpg");
  ASSERT_TRUE(texture.has_value()) << texture.error().message;
  EXPECT_EQ(texture->color.width(), 8);
  EXPECT_EQ(texture->color.at(3, 3), (Rgb{128, 128, 128}));
  EXPECT_FALSE(texture->cuts());
}

TEST(Texture, BrokenPicturesAreErrorsWithTheirNames) {
  const std::string png = *encode_texture(four_pixels());
  for (const std::string& good : {png, grey_jpeg()}) {
    for (std::size_t size = 0; size < good.size(); size += 3) {
      const auto texture = decode_texture(good.substr(0, size), "cut.pic");
      if (!texture) {
        EXPECT_EQ(texture.error().message.find("cut.pic"), 0U);
      }
    }
    Rng rng(1, "broken pictures");
    for (int i = 0; i < 1000; ++i) {
      std::string bad = good;
      for (int k = 0; k < 3; ++k) {
        const std::size_t at = rng.index(bad.size());
        // A header that promises a huge picture is no news and takes its time.
        const bool size_of_jpeg = good[0] != png[0] && at >= 76 && at < 80;
        if (!size_of_jpeg) bad[at] = static_cast<char>(rng.index(256));
      }
      static_cast<void>(decode_texture(bad, "bad.pic"));
    }
  }
  EXPECT_FALSE(decode_texture("GIF89a", "a.gif").has_value());
  EXPECT_FALSE(decode_texture("", "empty.png").has_value());
}

}  // namespace
}  // namespace canopeer
