#include "canopeer/config/cost_table_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

Expected<CostTable> table_of(const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto path = std::filesystem::temp_directory_path() /
                    (std::string("canopeer_costs_") + test->name() + ".yaml");
  EXPECT_TRUE(write_file(path, text));
  auto table = load_cost_table(path);
  std::filesystem::remove(path);
  return table;
}

std::string without(std::string text, Work kind) {
  const auto begin = text.find("  " + std::string(work_name(kind)));
  return text.erase(begin, text.find('\n', begin) + 1 - begin);
}

TEST(CostTableFile, IsReadAsItWasWritten) {
  CostTable written;
  for (std::size_t i = 0; i < kWorkKinds; ++i)
    written[static_cast<Work>(i)] = 1e-6 * static_cast<double>(i + 1);
  const auto read = table_of(cost_table_text(written, "a table"));
  ASSERT_TRUE(read) << read.error().message;
  for (std::size_t i = 0; i < kWorkKinds; ++i) {
    const auto kind = static_cast<Work>(i);
    EXPECT_DOUBLE_EQ((*read)[kind], written[kind]) << work_name(kind);
  }
}

TEST(CostTableFile, MayLeaveOutWhatEarlierVersionsDidNotCharge) {
  CostTable written;
  written[Work::fruit_frame] = 1.0;
  const std::string text = cost_table_text(written, "a table");
  const auto old = table_of(without(text, Work::fruit_frame));
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_EQ((*old)[Work::fruit_frame], 0.0);
  EXPECT_TRUE(table_of(without(text, Work::simplex_row)));
  const auto damaged = table_of(without(text, Work::view_cast));
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().message.find("view_cast"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
