#pragma once

#include <functional>
#include <vector>

#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::synthetic {

/// Something to look at: `distance(p)` is negative inside and never larger than the true distance.
struct Body {
  std::function<double(const Vec3&)> distance;
  Rgb color;
  bool fruit = false;
};

Body ball(const Vec3& centre, double radius, Rgb color, bool fruit);
/// Superellipsoid with e1 = e2 = e, upright; e = 1 is an ellipsoid, 0.6 a blocky pepper.
Body superellipsoid(const Vec3& centre, const Vec3& semi_axes, double e, Rgb color, bool fruit);
Body block(const Box& box, Rgb color);
/// Round bar from a to b.
Body bar(const Vec3& a, const Vec3& b, double radius, Rgb color);

struct View {
  RgbdFrame frame;
  Mask fruit;  ///< the truth
};

/// Sphere tracing with Lambert light over an ambient share of 0.4 and a small highlight; 320 × 240,
/// 40° wide (about as fine as 640 × 480 at 80°), range up to 3 m.
View look(const std::vector<Body>& bodies, const Vec3& from, const Vec3& to);

inline constexpr Rgb kRipe{204, 41, 9};
inline constexpr Rgb kTurning{227, 88, 23};
inline constexpr Rgb kGreen{162, 154, 35};
inline constexpr Rgb kLeaf{60, 83, 22};
inline constexpr Rgb kDryLeaf{120, 70, 40};

}  // namespace canopeer::synthetic
