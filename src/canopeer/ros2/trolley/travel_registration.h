#pragma once

#include <string>
#include <vector>

#include "canopeer/map/voxel_map.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::ros {

struct TravelRegistrationOptions {
  double reach_m = 0.2;      ///< shifts up to this are tried, both ways
  int max_points = 4000;     ///< of the frame, evenly drawn
  double max_range_m = 2.0;  ///< farther points are left out
};

/// By how much a frame lies beside the map along the row.
struct TravelRegistration {
  enum class Kind {
    clear,         ///< the map says it
    unclear,       ///< the map says nothing that can be believed
    nothing_there  ///< nothing is mapped where the frame looks
  };
  Kind kind = Kind::nothing_there;
  double shift_m = 0.0;    ///< the trolley stands farther by this; 0 unless clear
  double agreement = 0.0;  ///< at the best shift: share of points on what is mapped, less the share
                           ///< in what is known to be free
  double agreement_unshifted = 0.0;
  int points = 0;
};

/// Holds the points of a frame, seen from where the trolley is believed to stand, against what is
/// mapped, for shifts along `axis_world` (unit; where the trolley goes to as travel grows). Walls
/// and pipes along the row agree with every shift, so only what stands out of the agreement with
/// all others counts.
[[nodiscard]] TravelRegistration register_travel(const VoxelMap& map, const RgbdFrame& frame,
                                                 const Vec3& axis_world,
                                                 const TravelRegistrationOptions& options = {});

/// In words, for people: `believed_m` is where the trolley was thought to stand.
[[nodiscard]] std::string in_words(const TravelRegistration& registration, double believed_m);

}  // namespace canopeer::ros
