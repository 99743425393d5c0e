#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// How much of a fruit one camera position can see. Shares of surface, 0 … 1.
struct FruitView {
  double facing_share = 0.0;          ///< visible part of the surface that faces the camera
  std::vector<std::uint32_t> points;  ///< visible surface points, indices
};

/// Which parts of the fruits can be seen from where. Points are spread evenly over the fruits'
/// surfaces. From each a ray goes to the camera; nothing may block it, the fruit itself included.
class OcclusionProbe {
 public:
  explicit OcclusionProbe(const Scene& scene);
  ~OcclusionProbe();
  OcclusionProbe(const OcclusionProbe&) = delete;
  OcclusionProbe& operator=(const OcclusionProbe&) = delete;

  /// What a camera at `eye` sees of a fruit, whatever it looks at. Thread-safe.
  [[nodiscard]] FruitView view(int fruit, const Vec3& eye) const;
  /// Number of surface points of a fruit; each stands for the same area.
  [[nodiscard]] std::size_t point_count(int fruit) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What all allowed camera positions together show of one fruit.
struct FruitVisibility {
  int fruit = 0;
  int views = 0;                    ///< allowed positions
  double best = 0.0;                ///< facing share of the best of them
  double median = 0.0;              ///< of the median one
  double frontal = -1.0;            ///< of the one straight in front; −1: none
  double best_frontal_level = 0.0;  ///< of level ones 0.55 and 0.7 m away, up to 30° to the side
  double share_above_30 = 0.0;  ///< of the positions that show 30 % of the facing surface or more
  double union_surface = 0.0;   ///< of the whole surface seen from any position
  double union_frontal = 0.0;   ///< the same from all level positions in front
};

/// Positions on a ring: 165 directions spread evenly over the sphere, 0.3, 0.5 and 0.7 m from the
/// fruit. They lie within 0.45 m of the middle of the aisle (x = 0), and between 0.1 and 1.6 m
/// above the ground, or up to `top_m` where plants are taller.
struct RingOptions {
  int directions = 165;
  std::vector<double> distances_m = {0.3, 0.5, 0.7};
  double aisle_half_m = 0.45;
  double low_m = 0.1;
  double top_m = 1.6;
};
[[nodiscard]] std::vector<Vec3> ring_positions(const Vec3& fruit, const RingOptions& options);

/// Visibility of a fruit from given positions.
[[nodiscard]] FruitVisibility visibility(const OcclusionProbe& probe, const FruitTruth& fruit,
                                         const std::vector<Vec3>& eyes);

/// Visibility of the fruits that count, at most `limit` of them evenly picked, each from the
/// positions `eyes_of` allows it. In parallel; the result is the same with any number of threads.
[[nodiscard]] std::vector<FruitVisibility> visibilities(
    const Scene& scene, const OcclusionProbe& probe, int limit,
    const std::function<std::vector<Vec3>(const FruitTruth&)>& eyes_of);

}  // namespace canopeer
