#include "canopeer/sensing/jpeg.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace canopeer {
namespace {

ColorImage slope() {
  ColorImage image(64, 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u)
      image.at(u, v) = {static_cast<std::uint8_t>(4 * u), static_cast<std::uint8_t>(5 * v), 90};
  }
  return image;
}

TEST(Jpeg, GivesBackAlmostWhatWasWritten) {
  const ColorImage image = slope();
  const auto read = parse_jpeg(encode_jpeg(image, 95));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->width(), 64);
  ASSERT_EQ(read->height(), 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      EXPECT_NEAR(read->at(u, v).r, image.at(u, v).r, 8);
      EXPECT_NEAR(read->at(u, v).g, image.at(u, v).g, 8);
      EXPECT_NEAR(read->at(u, v).b, image.at(u, v).b, 8);
    }
  }
  EXPECT_EQ(encode_jpeg(ColorImage(), 95), "");
}

TEST(Jpeg, WhatWasCutOffIsRefusedOrGreyAsAskedFor) {
  const std::string bytes = encode_jpeg(slope(), 95);
  const std::string most = bytes.substr(0, bytes.size() - 100);
  EXPECT_FALSE(parse_jpeg(most).has_value());
  const auto read = parse_jpeg(most, {std::size_t{1} << 26, false});
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->height(), 48);
  EXPECT_NEAR(read->at(3, 1).b, 90, 8);
}

TEST(Jpeg, AnyCutAndAnyOtherBytesAreAnErrorInWords) {
  const std::string bytes = encode_jpeg(slope(), 60);
  for (std::size_t size = 0; size + 2 < bytes.size(); size += 7) {
    const auto read = parse_jpeg(std::string_view(bytes).substr(0, size));
    ASSERT_FALSE(read.has_value()) << size;
    EXPECT_NE(read.error().message, "");
  }
  EXPECT_FALSE(parse_jpeg("\xff\xd8 no picture").has_value());
}

TEST(Jpeg, WhatIsTooBigIsRefused) {
  const auto read = parse_jpeg(encode_jpeg(slope(), 60), {64 * 48 - 1});
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().message, "the picture is too big");
}

}  // namespace
}  // namespace canopeer
