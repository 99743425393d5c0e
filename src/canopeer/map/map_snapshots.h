#pragma once

#include <memory>
#include <mutex>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// Hands the state of a map from the one thread that changes it to any number that read. A reader
/// keeps the snapshot it took for as long as it likes; it is never changed. publish() and latest()
/// hold a lock for as long as it takes to copy a pointer, never while blocks are copied, fused or
/// freed.
class MapSnapshots {
 public:
  /// For the thread that owns `map`; costs a pointer per page of the map. Pages changed after this
  /// are copied before they are written to.
  void publish(const VoxelMap& map);
  /// The map published last; nullptr: none yet. For any thread.
  [[nodiscard]] std::shared_ptr<const VoxelMap> latest() const;

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const VoxelMap> latest_;
};

}  // namespace canopeer
