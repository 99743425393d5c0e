#pragma once

#include <string>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// World to picture, linear part: a point (m) becomes (right, down) in px.
using PictureProjection = Eigen::Matrix<double, 2, 3>;

/// A fruit as an ellipsoid in the world: centre + A·(unit ball), with shape = A·Aᵀ.
struct FruitBody {
  Vec3 centre = Vec3::Zero();
  Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();

  [[nodiscard]] Box bounds() const;
};

[[nodiscard]] FruitBody body_of(const FruitEstimate& fruit);
/// A true fruit hangs: its length is vertical.
[[nodiscard]] FruitBody body_of(const FruitTruth& fruit);

/// The outline of the body as an SVG ellipse, at least 2 px in radius; `attributes` go into the
/// element, `title` is shown when the pointer rests on it.
[[nodiscard]] std::string silhouette_svg(const FruitBody& body, const PictureProjection& projection,
                                         const Eigen::Vector2d& origin,
                                         const std::string& attributes, const std::string& title);

/// A diamond of the given half diagonal: what no ellipse can be taken for.
[[nodiscard]] std::string diamond_svg(const Eigen::Vector2d& at, double radius,
                                      const std::string& attributes, const std::string& title);

}  // namespace canopeer
