#include "canopeer/base/text_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "canopeer/base/byte_order.h"

namespace canopeer {
namespace {

TEST(TextLines, EndInEitherWayAndTheLastNeedsNoEnd) {
  TextLines lines("a\r\n\nb");
  EXPECT_EQ(lines.next(), "a");
  EXPECT_EQ(lines.rest(), "\nb");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "b");
  EXPECT_EQ(lines.number(), 3);
  EXPECT_FALSE(lines.next());
}

TEST(TextLines, WordsStandBetweenSeparators) {
  EXPECT_EQ(words_of("  a\tbc "), (std::vector<std::string_view>{"a", "bc"}));
  EXPECT_EQ(words_of("1, 2,3", " ,").size(), 3U);
  EXPECT_TRUE(words_of(" \t").empty());
}

TEST(TextLines, NumbersAreWholeWords) {
  EXPECT_EQ(to_number("-1.5e2"), -150.0);
  EXPECT_EQ(to_number("+2"), 2.0);
  EXPECT_TRUE(std::isnan(*to_number("nan")));
  for (const char* word : {"", "1x", "x", "+-1", "1,5"}) EXPECT_FALSE(to_number(word)) << word;
  EXPECT_EQ(to_integer("-12"), -12);
  EXPECT_FALSE(to_integer("1.5"));
  EXPECT_FALSE(to_integer("99999999999999999999"));
}

TEST(ByteOrderOfNumbers, IsTheOneAskedFor) {
  EXPECT_EQ(load_number<std::uint16_t>("\x01\x02", ByteOrder::big), 0x0102);
  EXPECT_EQ(load_number<std::uint16_t>("\x01\x02", ByteOrder::little), 0x0201);
  std::string bytes;
  append_number(bytes, -1.25F);
  append_number(bytes, std::int64_t{-7});
  EXPECT_EQ(bytes.substr(0, 4), std::string("\0\0\xA0\xBF", 4));
  EXPECT_EQ(load_number<float>(bytes.data()), -1.25F);
  EXPECT_EQ(load_number<std::int64_t>(bytes.data() + 4), -7);
}

}  // namespace
}  // namespace canopeer
