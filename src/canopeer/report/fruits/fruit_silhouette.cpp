#include "canopeer/report/fruits/fruit_silhouette.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/base/hypotenuse.h"
#include "canopeer/report/html_text.h"

namespace canopeer {

Box FruitBody::bounds() const {
  const Vec3 half = shape.diagonal().cwiseSqrt();
  return {centre - half, centre + half};
}

FruitBody body_of(const FruitEstimate& fruit) {
  const Vec3& angles = fruit.roll_pitch_yaw_rad;
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(angles.x(), Vec3::UnitX()))
          .toRotationMatrix();
  const Vec3 squares = fruit.semi_axes_m.cwiseAbs2();
  return {fruit.centre, rotation * squares.asDiagonal() * rotation.transpose()};
}

FruitBody body_of(const FruitTruth& fruit) {
  const Vec3 half(0.5 * fruit.diameter_m, 0.5 * fruit.diameter_m, 0.5 * fruit.length_m);
  return {fruit.centre, Eigen::Matrix3d(half.cwiseAbs2().asDiagonal())};
}

/// The silhouette of the body under the projection is the ellipse of P·S·Pᵀ.
std::string silhouette_svg(const FruitBody& body, const PictureProjection& p,
                           const Eigen::Vector2d& origin, const std::string& attributes,
                           const std::string& title) {
  const Eigen::Vector2d centre = origin + p * body.centre;
  const Eigen::Matrix2d m = p * body.shape * p.transpose();
  const double mean = 0.5 * (m(0, 0) + m(1, 1));
  const double difference = 0.5 * (m(0, 0) - m(1, 1));
  const double spread = hypotenuse(difference, m(0, 1));
  const double angle_deg = 0.5 * std::atan2(m(0, 1), difference) * 180.0 / std::numbers::pi;
  return fmt::format(
      "<ellipse cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.1f}\" ry=\"{3:.1f}\" "
      "transform=\"rotate({4:.0f} {0:.1f} {1:.1f})\" {5}><title>{6}</title></ellipse>\n",
      centre.x(), centre.y(), std::max(2.0, std::sqrt(mean + spread)),
      std::max(2.0, std::sqrt(std::max(0.0, mean - spread))), angle_deg, attributes,
      escape_html(title));
}

std::string diamond_svg(const Eigen::Vector2d& at, double r, const std::string& attributes,
                        const std::string& title) {
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z\" {}><title>{}</title>"
      "</path>\n",
      at.x(), at.y() - r, r, r, -r, r, -r, -r, attributes, escape_html(title));
}

}  // namespace canopeer
