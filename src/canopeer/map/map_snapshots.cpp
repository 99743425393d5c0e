#include "canopeer/map/map_snapshots.h"

namespace canopeer {

void MapSnapshots::publish(const VoxelMap& map) {
  auto snapshot = std::make_shared<const VoxelMap>(map);
  {
    const std::lock_guard lock(mutex_);
    latest_.swap(snapshot);
  }
  // The one before, if nobody reads it any more, is freed here, outside the lock.
}

std::shared_ptr<const VoxelMap> MapSnapshots::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

}  // namespace canopeer
