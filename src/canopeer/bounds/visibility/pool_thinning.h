#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "canopeer/bounds/view_pool.h"
#include "canopeer/robot/endless_joints.h"

namespace canopeer {

/// Which views of a segment are kept (ascending), the first in any case. A view goes whose patches
/// are all in another one's that is no farther than `near_rad` (Σ|Δq|). If more than `keep` remain,
/// greedy covers of them are taken, each of the views that the covers before have left, until there
/// are so many: the first shows all there is, each other one shows nearly all of it in another way.
/// More than `keep` remain only where the first cover has more.
[[nodiscard]] std::vector<std::size_t> views_to_keep(std::span<const PoolView> views,
                                                     const FruitPatches& patches,
                                                     const EndlessJoints& endless, double near_rad,
                                                     std::size_t keep);

}  // namespace canopeer
