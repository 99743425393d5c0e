#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace canopeer {

/// Kinds of computation a mission is charged for, each with its unit.
enum class Work : std::size_t {
  detect_frame,     ///< one frame searched for fruit pixels
  fuse_point,       ///< one depth pixel fused into the map
  field_block,      ///< one changed block brought into the distance field
  target_block,     ///< one block of the region whose frontiers are kept, per frame
  candidate,        ///< one view pose candidate drawn, with its target ray
  view_ik,          ///< one view pose solved for arm configurations
  state_check,      ///< one arm configuration checked for collisions
  neighbor_search,  ///< one nearest-neighbour query in the graph
  view_cast,        ///< one view's visible set computed
  expansion,        ///< one neighbour evaluated by the search
  exact_state,      ///< one arm configuration judged on the exact geometry
  motion_plan,      ///< one state checked by the global motion planner
  fruit_frame,      ///< one frame taken into the fruit map
  simplex_row,      ///< one row of an integer program in one iteration of the simplex
  count
};

inline constexpr std::size_t kWorkKinds = static_cast<std::size_t>(Work::count);

/// The name used in cost tables and records, e.g. "view_cast".
std::string_view work_name(Work kind);

/// Seconds of one core per unit of work. In simulated time they move a mission's clock on. So
/// planning costs mission time, and yet a run does not depend on the machine it is made on.
struct CostTable {
  std::array<double, kWorkKinds> seconds_per_unit{};

  double& operator[](Work kind) { return seconds_per_unit[static_cast<std::size_t>(kind)]; }
  double operator[](Work kind) const { return seconds_per_unit[static_cast<std::size_t>(kind)]; }
};

/// Counts work. Not thread-safe: parallel sections count on their own and merge.
class WorkMeter {
 public:
  void add(Work kind, std::int64_t units = 1) { units_[static_cast<std::size_t>(kind)] += units; }
  void merge(const WorkMeter& other);
  std::int64_t units(Work kind) const { return units_[static_cast<std::size_t>(kind)]; }
  /// Seconds all counted work costs by the table.
  double seconds(const CostTable& table) const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(units_);
  }

 private:
  std::array<std::int64_t, kWorkKinds> units_{};
};

}  // namespace canopeer
