#pragma once

#include <memory>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/fruit/instances/fruit_tracker.h"
#include "canopeer/fruit/surface/fruit_surface.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/point_cloud.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// The fruits found so far. Frames go in one by one; update() makes fruits of what has been seen.
/// One map for the whole mission, in the world: what is seen from both sides of a row, or in
/// several segments, comes together on the same surface. Deterministic; one owner (not
/// thread-safe).
class FruitMap {
 public:
  explicit FruitMap(const FruitMapOptions& options = {});
  ~FruitMap();
  FruitMap(FruitMap&&) noexcept;
  FruitMap& operator=(FruitMap&&) noexcept;

  /// Takes in a frame; `fruit` has its size and holds 0 where there is none, else the PixelLabel.
  void add(const RgbdFrame& frame, const Mask& fruit);

  /// Estimates the fruits near what has changed: all new ones, and of those known before as many as
  /// options.update_points allows, the longest waiting first. Ids are given once and follow a fruit
  /// by its surface from update to update.
  void update();
  /// The same for all there is, nothing left waiting, shapes fitted as if for the first time: what
  /// a run ends with.
  void update_all();

  /// As of the last update(), by ascending id: those at min_confidence or more.
  [[nodiscard]] const std::vector<FruitEstimate>& fruits() const;
  /// The same with the unlikely ones, down to confidence 0.
  [[nodiscard]] const std::vector<FruitEstimate>& candidates() const;
  /// What tells about candidates()[i].
  [[nodiscard]] FruitEvidence evidence(std::size_t i) const;
  /// Merges and splits of ids since the beginning.
  [[nodiscard]] const std::vector<IdChange>& id_changes() const;
  /// Blocks of new surface that wait for an update.
  [[nodiscard]] int waiting() const;
  /// Shapes fitted since the beginning.
  [[nodiscard]] int fits() const;

  /// Points of the fruit surface with mean colours and normals, world.
  [[nodiscard]] PointCloud cloud() const;
  /// The same as triangles, each vertex with the id of its fruit.
  [[nodiscard]] SurfaceMesh surface() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
