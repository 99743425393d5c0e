#include "canopeer/base/compute_cost.h"

#include "canopeer/base/check.h"

namespace canopeer {

std::string_view work_name(Work kind) {
  static constexpr std::array<std::string_view, kWorkKinds> kNames = {
      "detect_frame", "fuse_point",  "field_block",     "target_block", "candidate",
      "view_ik",      "state_check", "neighbor_search", "view_cast",    "expansion",
      "exact_state",  "motion_plan", "fruit_frame",     "simplex_row"};
  CANOPEER_CHECK(kind < Work::count, "unknown kind of work");
  return kNames[static_cast<std::size_t>(kind)];
}

void WorkMeter::merge(const WorkMeter& other) {
  for (std::size_t i = 0; i < kWorkKinds; ++i) units_[i] += other.units_[i];
}

double WorkMeter::seconds(const CostTable& table) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < kWorkKinds; ++i) {
    sum += static_cast<double>(units_[i]) * table.seconds_per_unit[i];
  }
  return sum;
}

}  // namespace canopeer
