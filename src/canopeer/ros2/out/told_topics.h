#pragma once

#include "canopeer/cdr/messages/nav_msgs.h"
#include "canopeer/cdr/messages/octomap_msgs.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/cdr/messages/vision_msgs.h"
#include "canopeer/cdr/messages/visualization_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/mission/event.h"
#include "canopeer/ros2/out/told_topic.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// What is told of map, fruits, plan and camera, each on a topic of its own under `~/`
/// (docs/formats.md). Used from one thread.
class ToldTopics {
 public:
  [[nodiscard]] Expected<void> open(Node& node);

  // What is new; the stamp is of when it was so.
  void offer(const MapChanged& event, const std_msgs::Header& in_map);
  void offer(const FruitsFound& event, const std_msgs::Header& in_map);
  void offer(const Planned& event, const std_msgs::Header& in_map);
  void offer(const FrameTaken& event, const std_msgs::Header& in_map,
             const std_msgs::Header& in_camera);

  struct Rates {
    double map_hz = 1.0;
    double image_hz = 2.0;
  };
  void tell_what_is_due(const Rates& rates);
  /// The newest of those that are told at all.
  void tell_all(const Rates& rates);

 private:
  /// `tell(topic, rate)` of each.
  template <class Tell>
  void for_each(const Rates& rates, Tell tell) {
    tell(occupied_, rates.map_hz);
    tell(roi_, rates.map_hz);
    tell(octomap_binary_, rates.map_hz);
    tell(octomap_full_, rates.map_hz);
    tell(fruits_, rates.map_hz);
    tell(fruit_markers_, rates.map_hz);
    tell(graph_, rates.image_hz);
    tell(path_, rates.image_hz);
    tell(frustum_, rates.image_hz);
    tell(detections_, rates.image_hz);
  }

  ToldTopic<sensor_msgs::PointCloud2> occupied_, roi_;
  ToldTopic<octomap_msgs::Octomap> octomap_binary_, octomap_full_;
  ToldTopic<vision_msgs::Detection3DArray> fruits_;
  ToldTopic<visualization_msgs::MarkerArray> fruit_markers_, graph_;
  ToldTopic<nav_msgs::Path> path_;
  ToldTopic<visualization_msgs::Marker> frustum_;
  ToldTopic<sensor_msgs::Image> detections_;
};

}  // namespace canopeer::ros
