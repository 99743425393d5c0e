#pragma once

#include <optional>

#include "canopeer/fruit/row_place.h"
#include "canopeer/geometry/superellipsoid.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// "green", "turning", "ripe"; "none" for the background.
constexpr const char* ripeness_name(PixelLabel label) {
  switch (label) {
    case PixelLabel::green_fruit:
      return "green";
    case PixelLabel::turning_fruit:
      return "turning";
    case PixelLabel::ripe_fruit:
      return "ripe";
    case PixelLabel::background:
      break;
  }
  return "none";
}

/// One fruit as far as it is known: a superellipsoid with its pose, and how sure that is.
struct FruitEstimate {
  int id = 0;
  Vec3 centre = Vec3::Zero();       ///< world
  Vec3 semi_axes_m = Vec3::Zero();  ///< a, b, c
  double e1 = 1.0;
  double e2 = 1.0;
  Vec3 roll_pitch_yaw_rad = Vec3::Zero();  ///< R = Rz(yaw) Ry(pitch) Rx(roll), fruit frame to world
  double volume_cm3 = 0.0;
  int points = 0;           ///< distinct surface cells seen
  double confidence = 0.0;  ///< that it is a fruit: of those at confidence c about c are, 0 … 1

  Vec3 centre_sd_m = Vec3::Zero();               ///< standard errors along x, y, z
  double volume_sd_cm3 = 0.0;                    ///< standard error
  double rms_m = 0.0;                            ///< of the points' radial distances from the shape
  double seen_share = 0.0;                       ///< of the shape's surface, 0 … 1
  PixelLabel ripeness = PixelLabel::background;  ///< background: nobody said
  Rgb color;                                     ///< mean of the seen surface
  int views = 0;                                 ///< frames it was seen in
  double first_seen_s = 0.0;                     ///< mission time
  double last_seen_s = 0.0;
  std::optional<RowPlace> place;

  [[nodiscard]] Superellipsoid body() const {
    Superellipsoid b;
    b.semi_axes_m = semi_axes_m;
    b.e1 = e1;
    b.e2 = e2;
    b.T_world_body.translation() = centre;
    b.T_world_body.linear() = rotation_of(roll_pitch_yaw_rad);
    return b;
  }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(id, centre, semi_axes_m, e1, e2, roll_pitch_yaw_rad, volume_cm3, points, confidence);
    archive(centre_sd_m, volume_sd_cm3, rms_m, seen_share, ripeness, color, views);
    archive(first_seen_s, last_seen_s, place);
  }
};

}  // namespace canopeer
