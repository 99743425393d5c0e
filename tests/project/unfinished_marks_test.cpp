#include <gtest/gtest.h>

#include <regex>

#include "source_tree.h"

namespace canopeer {
namespace {

TEST(Sources, CarryNoMarksOfUnfinishedWork) {
  // Put together here, so that this file passes its own test.
  static const std::regex mark(std::string("\\b(TO") + "DO|FIX" + "ME|X" + "XX|HA" + "CK)\\b");
  for (const char* dir : {"src", "apps", "tests", "bench"}) {
    for (const auto& file : testing_support::source_files(dir)) {
      int number = 0;
      for (const std::string& line : testing_support::lines_of(file)) {
        ++number;
        EXPECT_FALSE(std::regex_search(line, mark))
            << file.lexically_relative(testing_support::source_root()).string() << ":" << number
            << ": " << line;
      }
    }
  }
}

}  // namespace
}  // namespace canopeer
