#include "canopeer/ros2/out/told_topics.h"

#include <algorithm>
#include <utility>

#include "canopeer/ros2/out/detection_picture.h"
#include "canopeer/ros2/out/fruit_detections.h"
#include "canopeer/ros2/out/fruit_markers.h"
#include "canopeer/ros2/out/frustum_marker.h"
#include "canopeer/ros2/out/octomap_message.h"
#include "canopeer/ros2/out/plan_markers.h"
#include "canopeer/ros2/out/voxel_cloud.h"

namespace canopeer::ros {
namespace {

constexpr double kFrustumDepth_m = 0.5;

/// Null when the map cannot be an octree: the clouds show it all the same.
std::optional<octomap_msgs::Octomap> octomap_or_none(const VoxelMap& map, bool binary,
                                                     const std_msgs::Header& header) {
  auto message = octomap_message(map, binary, header);
  if (!message) return std::nullopt;
  return std::move(*message);
}

}  // namespace

Expected<void> ToldTopics::open(Node& node) {
  Expected<void> opened;
  const auto also = [&](auto& topic, const char* name) {
    if (opened) opened = topic.open(node, name);
  };
  also(occupied_, "~/occupied_voxels");
  also(roi_, "~/roi_voxels");
  also(octomap_binary_, "~/octomap_binary");
  also(octomap_full_, "~/octomap_full");
  also(fruits_, "~/fruits");
  also(fruit_markers_, "~/fruit_markers");
  also(graph_, "~/graph");
  also(path_, "~/path");
  also(frustum_, "~/frustum");
  also(detections_, "~/detections");
  return opened;
}

void ToldTopics::offer(const MapChanged& event, const std_msgs::Header& in_map) {
  if (event.map == nullptr) return;
  const auto& map = event.map;
  occupied_.offer([map, in_map] { return occupied_cloud(*map, in_map); });
  roi_.offer([map, in_map] { return roi_cloud(*map, in_map); });
  octomap_binary_.offer([map, in_map] { return octomap_or_none(*map, true, in_map); });
  octomap_full_.offer([map, in_map] { return octomap_or_none(*map, false, in_map); });
}

void ToldTopics::offer(const FruitsFound& event, const std_msgs::Header& in_map) {
  const auto fruits = std::make_shared<const std::vector<FruitEstimate>>(event.fruits);
  fruits_.offer([fruits, in_map] { return fruit_detections(*fruits, in_map); });
  fruit_markers_.offer([fruits, in_map] { return fruit_markers(*fruits, in_map); });
}

void ToldTopics::offer(const Planned& event, const std_msgs::Header& in_map) {
  if (event.sketch == nullptr) return;
  const auto& sketch = event.sketch;
  graph_.offer([sketch, in_map] { return plan_markers(*sketch, in_map); });
  path_.offer([sketch, in_map] { return plan_path(*sketch, in_map); });
}

void ToldTopics::offer(const FrameTaken& event, const std_msgs::Header& in_map,
                       const std_msgs::Header& in_camera) {
  const auto& frame = event.frame;
  if (frame == nullptr) return;
  frustum_.offer([frame, in_map] {
    const double depth_m = std::min(kFrustumDepth_m, frame->intrinsics.max_range_m);
    return frustum_marker(frame->intrinsics, frame->T_world_camera, depth_m, in_map);
  });
  const auto& detection = event.detection;
  detections_.offer([frame, detection, in_camera] {
    return detection_picture(*frame, detection == nullptr ? Detection() : *detection, in_camera);
  });
}

void ToldTopics::tell_what_is_due(const Rates& rates) {
  const auto now = std::chrono::steady_clock::now();
  for_each(rates, [&](auto& topic, double rate_hz) { topic.tell_if_due(now, rate_hz); });
}

void ToldTopics::tell_all(const Rates& rates) {
  const auto now = std::chrono::steady_clock::now();
  for_each(rates, [&](auto& topic, double rate_hz) {
    if (rate_hz > 0.0) topic.tell(now);
  });
}

}  // namespace canopeer::ros
