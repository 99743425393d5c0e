#pragma once

#include <map>
#include <vector>

#include "canopeer/record/run_record.h"

namespace canopeer {

/// Fruits known after a frame, at a view or on the way.
struct FruitsAtTime {
  double t_s = 0.0;  ///< when the frame was taken, mission time
  const std::vector<FruitSnapshot>* fruits = nullptr;
  bool on_the_way = false;
};

/// What was known after each frame, views and frames on the way together, by time. It points into
/// the record, which must outlive it.
[[nodiscard]] std::vector<FruitsAtTime> fruit_course(const RunRecord& record);

/// By fruit's id: the first frame after which it was known.
[[nodiscard]] std::map<int, FruitsAtTime> first_known(const std::vector<FruitsAtTime>& course);

}  // namespace canopeer
