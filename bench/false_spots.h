#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "canopeer/scene/scene.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// What a network gets wrong again and again at the same place: spots on leaves, stems and whatever
/// else stands there that it takes for fruit, and fruits that it misses now and then. Each place
/// has a share of frames of its own in which it is wrong, uniform in a range, and keeps it. A
/// frame's pixels in a spot are wrong together, one in twenty excepted.
class FalseSpots {
 public:
  FalseSpots(const Scene& scene, std::uint64_t seed);

  /// Changes the detector's answer for a frame (of the same size; depth must be the true one).
  void apply(const RgbdFrame& truth, std::uint64_t frame_number, Mask& fruit) const;

 private:
  struct Spot {
    Vec3 centre;
    double radius_m = 0.0;
    double wrong = 0.0;      ///< share of the frames
    bool says_fruit = true;  ///< false: says there is none
  };
  void add(const Spot& spot);

  std::uint64_t seed_;
  std::vector<Spot> spots_;
  std::unordered_map<std::uint64_t, std::vector<int>> near_;  ///< by cell of 0.1 m; never iterated
};

}  // namespace canopeer
