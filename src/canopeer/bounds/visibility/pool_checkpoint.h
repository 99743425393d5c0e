#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/bounds/view_pool.h"

namespace canopeer {

/// A pool under way: segments that are done, and what has been sampled of the next.
struct PoolState {
  ViewPool pool;
  int batches = 0;
  std::vector<PoolView> views;            ///< that show something; the first is at home
  std::vector<std::uint32_t> times_seen;  ///< by patch, in this segment
  PoolCourse course;                      ///< of this segment
  int again = 0;                          ///< segments gone through again, round after round

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(pool, batches, views, times_seen, course, again);
  }
};

/// What the file says, if it is a checkpoint of the pool with that key; else a new beginning. No
/// path: a new beginning.
[[nodiscard]] PoolState checkpoint_or_start(const std::filesystem::path& path,
                                            const std::string& key, const FruitPatches& patches);
[[nodiscard]] Expected<void> write_checkpoint(const std::filesystem::path& path,
                                              const PoolState& state);

}  // namespace canopeer
