#pragma once

#include <vector>

#include "canopeer/scene/plants/foliage.h"

namespace canopeer {

/// How well a plant's leaves hide a place from level views in front of the row. Each blade stands
/// as the flat ellipse between its midrib's ends. Plant frame, rows along y, aisles on both sides.
class CanopyCover {
 public:
  explicit CanopyCover(const std::vector<PlacedLeaf>& leaves);

  /// Largest share of a body of this radius (m) at `centre` that any of fourteen level directions
  /// shows. They go up to 30° to either side of straight in front, from both aisles.
  [[nodiscard]] double shown_level(const Vec3& centre, double radius_m) const;

 private:
  struct Ellipse {
    Vec3 centre;
    Vec3 along;   ///< 1 / half length long: 1 at the end
    Vec3 across;  ///< 1 / half width long
    Vec3 normal;
    double reach_m;
  };
  [[nodiscard]] static bool touches(const Ellipse& blade, const Vec3& centre, double radius_m);
  [[nodiscard]] double shown(const std::vector<const Ellipse*>& near, const Vec3& centre,
                             double radius_m, const Vec3& towards) const;

  std::vector<Ellipse> blades_;
};

}  // namespace canopeer
