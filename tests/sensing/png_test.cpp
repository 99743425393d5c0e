#include "canopeer/sensing/png.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

TEST(Png, ReadsBackWhatItWrote) {
  ColorImage image(37, 21);
  for (int v = 0; v < 21; ++v) {
    for (int u = 0; u < 37; ++u) {
      image.at(u, v) = {static_cast<std::uint8_t>(u * 6), static_cast<std::uint8_t>(v * 12),
                        static_cast<std::uint8_t>(u ^ v)};
    }
  }
  const auto path = scratch("png_color.png");
  ASSERT_TRUE(write_png(path, image));
  const auto read = read_png(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->width(), 37);
  EXPECT_TRUE(read->pixels() == image.pixels());
}

TEST(Png, WritesDepthAsSixteenBitMillimetres) {
  DepthImage depth(2, 2);
  depth.at(0, 0) = 1.2345F;
  depth.at(1, 0) = std::numeric_limits<float>::quiet_NaN();
  depth.at(0, 1) = 1000.0F;
  const auto path = scratch("png_depth.png");
  ASSERT_TRUE(write_depth_png(path, depth));
  // Width, height, 16 bits, grey at their places in the header chunk (PNG specification, 11.2.2).
  const auto bytes = read_file(path);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->substr(16, 10), std::string("\0\0\0\2\0\0\0\2\x10\0", 10));
  // Read as colour, the high byte of 65535 mm is white and no return is black.
  const auto read = read_png(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->at(0, 1).r, 255);
  EXPECT_EQ(read->at(1, 0).r, 0);
}

TEST(Png, SaysWhichFileIsBad) {
  const auto missing = read_png(scratch("no_such.png"));
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("no_such.png"), std::string::npos);

  const auto path = scratch("not_a.png");
  ASSERT_TRUE(write_file(path, "hello"));
  const auto text = read_png(path);
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().message.find("not a PNG"), std::string::npos);

  const auto cut = scratch("cut.png");
  ASSERT_TRUE(write_png(cut, ColorImage(64, 64, {1, 2, 3})));
  const auto whole = read_file(cut);
  ASSERT_TRUE(whole);
  ASSERT_TRUE(write_file(cut, whole->substr(0, whole->size() / 2)));
  EXPECT_FALSE(read_png(cut));

  EXPECT_FALSE(write_png(scratch("no_such_directory/a.png"), ColorImage(1, 1)));
  EXPECT_FALSE(write_png(scratch("empty.png"), ColorImage()));
}

}  // namespace
}  // namespace canopeer
