#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/fruit/instances/fruit_tracker.h"
#include "canopeer/fruit/surface/fruit_surface.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/point_cloud.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// The fruits found so far. Frames go in one by one; update() makes fruits of what has been seen.
/// There is one map for the whole mission, in the world: what is seen from both sides of a row, or
/// in several segments, comes together on the same surface. A value: a copy goes on by itself, as
/// the original would. Deterministic; one owner (not thread-safe).
class FruitMap {
 public:
  explicit FruitMap(const FruitMapOptions& options = {});
  ~FruitMap();
  FruitMap(const FruitMap& other);
  FruitMap& operator=(const FruitMap& other);
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

  /// All that later calls depend on, at any moment between them, as bytes: the surface in its
  /// blocks of voxels, which of it waits, the fruits with their shapes, ids and lost ids, sights
  /// that still count. A map restored from it gives, to the last bit, what this one would. Without
  /// the options and without a checksum. Some 9 kB for each block of 8³ voxels near fruit (26 MB
  /// after a mission with 47 fruits, written in 40 ms), half of that compressed.
  [[nodiscard]] std::string state() const;
  /// Takes the place of all this map knows. Its options must be those that the state was made with;
  /// an error when those of the signed distances (`tsdf`) are not, others hold from here on. Also
  /// an error when the bytes are cut short, too long or make no sense; then the map is as it was.
  /// Any bytes may come, but numbers that are just other numbers are taken for what they are.
  [[nodiscard]] Expected<void> restore(std::string_view state);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
