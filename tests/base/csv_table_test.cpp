#include "canopeer/base/csv_table.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

TEST(CsvTable, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(CsvTable::parse("a,b\n1,2\n3\n", "f.csv").error().message,
            "f.csv:3: 1 fields, expected 2 as in the header");
  const Expected<CsvTable> table = CsvTable::parse("a,b\r\n1, x\r\n", "f.csv");
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->number(0, "b").error().message, "f.csv:2: 'x' in column 'b', expected a number");
  EXPECT_EQ(table->number(0, "c").error().message, "f.csv: column 'c' is missing");
}

TEST(CsvTable, FindsColumnsByNameInAnyOrder) {
  const Expected<CsvTable> table = CsvTable::parse("b,a\n\n-1.5e-3,7\n", "f.csv");
  ASSERT_TRUE(table.has_value());
  ASSERT_EQ(table->rows(), 1U);
  EXPECT_EQ(*table->integer(0, "a"), 7);
  EXPECT_EQ(*table->number(0, "b"), -1.5e-3);
  EXPECT_FALSE(table->integer(0, "b").has_value());
  EXPECT_FALSE(CsvTable::parse("", "f.csv").has_value());
}

TEST(CsvTable, ASpreadsheetsMarkIsNoPartOfTheFirstName) {
  const auto table = CsvTable::parse("\xEF\xBB\xBFid,x_m\r\n1,0.5\r\n", "a.csv");
  ASSERT_TRUE(table.has_value());
  EXPECT_TRUE(table->has("id"));
  EXPECT_EQ(table->number(0, "x_m").value(), 0.5);
}

}  // namespace
}  // namespace canopeer
