#pragma once

#include <memory>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/point_cloud.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// The fruits found so far. Frames go in one by one; update() makes fruits of what has been seen.
/// Deterministic; one owner (not thread-safe).
class FruitMap {
 public:
  explicit FruitMap(const FruitMapOptions& options = {});
  ~FruitMap();
  FruitMap(FruitMap&&) noexcept;
  FruitMap& operator=(FruitMap&&) noexcept;

  /// Adds the frame's fruit pixels; `fruit` has the frame's size. Pixels at depth edges, at grazing
  /// incidence and out of range are left out.
  void add(const RgbdFrame& frame, const Mask& fruit);

  /// Re-estimates the fruits near what changed since the last call. Ids are given once and follow a
  /// fruit from update to update by its nearest previous centre.
  void update();

  /// As of the last update(), by ascending id.
  [[nodiscard]] const std::vector<FruitEstimate>& fruits() const;

  /// All surface cells seen so far with mean colours and normals, world; in the order first seen.
  [[nodiscard]] PointCloud cloud() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
