#include "canopeer/ros2/out/fruit_detections.h"

#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {
namespace {

vision_msgs::Detection3D detection_of(const FruitEstimate& fruit, const std_msgs::Header& header) {
  vision_msgs::Detection3D detection;
  detection.header = header;
  detection.id = std::to_string(fruit.id);
  detection.bbox.center = pose_of(fruit.body().T_world_body);
  detection.bbox.size = vector_of(2.0 * fruit.semi_axes_m);

  vision_msgs::ObjectHypothesisWithPose& fruit_it_is = detection.results.emplace_back();
  fruit_it_is.hypothesis.class_id =
      fruit.ripeness == PixelLabel::background ? "fruit" : ripeness_name(fruit.ripeness);
  fruit_it_is.hypothesis.score = fruit.confidence;
  fruit_it_is.pose.pose = detection.bbox.center;
  for (int axis = 0; axis < 3; ++axis) {
    const double sd = fruit.centre_sd_m[axis];
    fruit_it_is.pose.covariance[static_cast<std::size_t>(7 * axis)] = sd * sd;
  }
  return detection;
}

}  // namespace

vision_msgs::Detection3DArray fruit_detections(const std::vector<FruitEstimate>& fruits,
                                               const std_msgs::Header& header) {
  vision_msgs::Detection3DArray message;
  message.header = header;
  message.detections.reserve(fruits.size());
  for (const FruitEstimate& fruit : fruits) {
    message.detections.push_back(detection_of(fruit, header));
  }
  return message;
}

}  // namespace canopeer::ros
