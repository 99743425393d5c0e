#include "canopeer/ros2/out/fruit_markers.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "canopeer/ros2/out/label_colors.h"
#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {
namespace {

using visualization_msgs::Marker;

constexpr int kAround = 12;  // pieces of a ring
constexpr int kRings = 6;    // from pole to pole
constexpr double kTextHeight_m = 0.02;

/// A point of the surface in the body's frame; `around` and `down` in pieces from the north pole.
Vec3 surface_point(const Superellipsoid& body, int around, int down) {
  const double azimuth = 2.0 * std::numbers::pi * around / kAround;
  const double polar = std::numbers::pi * down / kRings;
  const Vec3 direction = body.semi_axes_m.cwiseProduct(Vec3(
      std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
  // The gauge grows along a ray in proportion to the distance; 1 is the surface.
  return direction / body.gauge(body.T_world_body * direction);
}

void add_triangle(Marker& marker, const Vec3& a, const Vec3& b, const Vec3& c) {
  for (const Vec3& corner : {a, b, c}) marker.points.push_back(point_of(corner));
}

Marker shape_marker(const FruitEstimate& fruit, const std_msgs::Header& header) {
  const Superellipsoid body = fruit.body();
  Marker marker;
  marker.header = header;
  marker.ns = "shapes";
  marker.id = fruit.id;
  marker.type = Marker::TRIANGLE_LIST;
  marker.pose = pose_of(body.T_world_body);
  marker.scale = {1.0, 1.0, 1.0};
  marker.color =
      color_of(label_color(fruit.ripeness), 0.25F + 0.75F * static_cast<float>(fruit.confidence));
  for (int down = 0; down < kRings; ++down) {
    for (int around = 0; around < kAround; ++around) {
      const Vec3 a = surface_point(body, around, down);
      const Vec3 b = surface_point(body, around, down + 1);
      const Vec3 c = surface_point(body, around + 1, down + 1);
      const Vec3 d = surface_point(body, around + 1, down);
      if (down + 1 < kRings) add_triangle(marker, a, b, c);
      if (down > 0) add_triangle(marker, a, c, d);
    }
  }
  return marker;
}

Marker name_marker(const FruitEstimate& fruit, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = "names";
  marker.id = fruit.id;
  marker.type = Marker::TEXT_VIEW_FACING;
  const double above = fruit.semi_axes_m.maxCoeff() + kTextHeight_m;
  marker.pose.position = point_of(fruit.centre + above * Vec3::UnitZ());
  marker.scale.z = kTextHeight_m;
  marker.color = {1.0F, 1.0F, 1.0F, 1.0F};
  marker.text = fmt::format("{}: {:.0f} ± {:.0f} cm³, {:.0f} %", fruit.id, fruit.volume_cm3,
                            fruit.volume_sd_cm3, 100.0 * fruit.confidence);
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray fruit_markers(const std::vector<FruitEstimate>& fruits,
                                              const std_msgs::Header& header) {
  visualization_msgs::MarkerArray message;
  message.markers.reserve(2 * fruits.size() + 1);
  Marker& none_before = message.markers.emplace_back();
  none_before.header = header;
  none_before.action = Marker::DELETEALL;
  for (const FruitEstimate& fruit : fruits) {
    message.markers.push_back(shape_marker(fruit, header));
    message.markers.push_back(name_marker(fruit, header));
  }
  return message;
}

}  // namespace canopeer::ros
