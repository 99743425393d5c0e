#pragma once

#include <vector>

#include "canopeer/map/storage/block.h"

namespace canopeer {

/// Sorts keys of which none comes twice. Blocks of a frame lie close together: each gets a bit in
/// the box around them; blocks far and wide are sorted by comparing.
void sort_keys(std::vector<BlockKey>& keys);

}  // namespace canopeer
