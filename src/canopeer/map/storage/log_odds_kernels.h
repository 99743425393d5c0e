#pragma once

#include <cstdint>

#include "canopeer/base/simd_level.h"
#include "canopeer/map/storage/block.h"

namespace canopeer {

/// Steps and limits of log-odds in fixed point. Limits and steps lie within ± 2^14, so no sum
/// overflows 16 bits.
struct LogOddsSteps {
  std::int16_t hit = 0, miss = 0, min = 0, max = 0, threshold = 0;
};

/// Where log-odds are clamped, fixed point.
struct LogOddsRange {
  std::int16_t min = 0, max = 0;
};

/// What applying an update spends its time in, for one instruction set. `cells`: the 512 log-odds
/// of a block, x fastest.
struct LogOddsKernels {
  /// Adds the steps, clamps, and refreshes the bits of `above` (log-odds ≥ threshold) where
  /// stepped. No voxel is in both hit and miss.
  void (*step)(std::int16_t* cells, const VoxelMask& hit, const VoxelMask& miss,
               const LogOddsSteps& steps, VoxelMask& above);
  /// `value` for the voxels of `mask`, 0 for the others.
  void (*fill)(std::int16_t* cells, const VoxelMask& mask, std::int16_t value);
  /// A miss for every voxel; `above` is not touched. Returns the least and largest value now.
  LogOddsRange (*miss_all)(std::int16_t* cells, const LogOddsSteps& steps);
};

/// `level` must be one the machine has.
const LogOddsKernels& log_odds_kernels(SimdLevel level);

}  // namespace canopeer
