#include "canopeer/ros2/out/plan_markers.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "canopeer/ros2/out/label_colors.h"
#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {
namespace {

using visualization_msgs::Marker;

constexpr Rgb kVisited{120, 120, 120};
constexpr double kAxis_m = 0.04;

/// Views are sorted by id; null: there is none of that id.
const PlanSketch::View* find_view(const PlanSketch& sketch, std::int32_t id) {
  const auto at = std::lower_bound(
      sketch.views.begin(), sketch.views.end(), id,
      [](const PlanSketch::View& view, std::int32_t wanted) { return view.id < wanted; });
  return at != sketch.views.end() && at->id == id ? &*at : nullptr;
}

std::vector<const PlanSketch::View*> views_of_path(const PlanSketch& sketch) {
  std::vector<const PlanSketch::View*> views;
  if (sketch.at) views.push_back(find_view(sketch, *sketch.at));
  for (const std::int32_t id : sketch.path) views.push_back(find_view(sketch, id));
  std::erase(views, nullptr);
  return views;
}

Marker empty_marker(const std_msgs::Header& header, const std::string& ns, std::int32_t type,
                    double width_m) {
  Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.type = type;
  marker.scale.x = width_m;
  if (type == Marker::SPHERE_LIST) marker.scale = {width_m, width_m, width_m};
  marker.color = {1.0F, 1.0F, 1.0F, 1.0F};
  return marker;
}

/// Viewers complain about lists without points.
Marker or_deleted(Marker marker) {
  if (marker.points.empty()) marker.action = Marker::DELETE;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray plan_markers(const PlanSketch& sketch,
                                             const std_msgs::Header& header) {
  Marker views = empty_marker(header, "views", Marker::SPHERE_LIST, 0.012);
  Marker axes = empty_marker(header, "axes", Marker::LINE_LIST, 0.003);
  for (const PlanSketch::View& view : sketch.views) {
    const std_msgs::ColorRGBA color = color_of(view.visited ? kVisited : target_color(view.kind));
    const Vec3 eye = view.T_world_camera.translation();
    views.points.push_back(point_of(eye));
    views.colors.push_back(color);
    axes.points.push_back(point_of(eye));
    axes.points.push_back(point_of(view.T_world_camera * Vec3(0.0, 0.0, kAxis_m)));
    axes.colors.insert(axes.colors.end(), 2, color);
  }

  Marker edges = empty_marker(header, "edges", Marker::LINE_LIST, 0.001);
  edges.color = {0.6F, 0.6F, 0.7F, 0.4F};
  for (const PlanSketch::Edge& edge : sketch.edges) {
    const PlanSketch::View* a = find_view(sketch, edge.a);
    const PlanSketch::View* b = find_view(sketch, edge.b);
    if (a == nullptr || b == nullptr) continue;
    edges.points.push_back(point_of(a->T_world_camera.translation()));
    edges.points.push_back(point_of(b->T_world_camera.translation()));
  }

  Marker path = empty_marker(header, "path", Marker::LINE_STRIP, 0.008);
  path.color = {1.0F, 0.85F, 0.1F, 1.0F};
  for (const PlanSketch::View* view : views_of_path(sketch)) {
    path.points.push_back(point_of(view->T_world_camera.translation()));
  }
  if (path.points.size() < 2) path.points.clear();

  visualization_msgs::MarkerArray message;
  for (Marker& marker : {std::ref(views), std::ref(axes), std::ref(edges), std::ref(path)}) {
    message.markers.push_back(or_deleted(std::move(marker)));
  }
  return message;
}

nav_msgs::Path plan_path(const PlanSketch& sketch, const std_msgs::Header& header) {
  nav_msgs::Path path;
  path.header = header;
  for (const PlanSketch::View* view : views_of_path(sketch)) {
    path.poses.push_back({header, pose_of(view->T_world_camera)});
  }
  return path;
}

}  // namespace canopeer::ros
