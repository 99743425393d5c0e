#include "canopeer/base/compute_cost.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace canopeer {
namespace {

TEST(WorkMeter, ChargesUnitsByTheTable) {
  CostTable table;
  table[Work::view_cast] = 0.25;
  table[Work::candidate] = 0.5;
  WorkMeter meter;
  meter.add(Work::view_cast, 4);
  WorkMeter other;
  other.add(Work::candidate);
  other.add(Work::expansion, 1000);  // costs nothing by this table
  meter.merge(other);
  EXPECT_EQ(meter.units(Work::view_cast), 4);
  EXPECT_DOUBLE_EQ(meter.seconds(table), 1.5);
}

TEST(Work, EveryKindHasANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kWorkKinds; ++i) names.emplace(work_name(static_cast<Work>(i)));
  EXPECT_EQ(names.size(), kWorkKinds);
  EXPECT_FALSE(names.contains(""));
}

}  // namespace
}  // namespace canopeer
