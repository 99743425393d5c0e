#include "canopeer/ros2/camera/ros2_camera.h"

#include <algorithm>
#include <string_view>

namespace canopeer::ros {
namespace {

bool ends_with(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool is_compressed(const std::string& topic) {
  return ends_with(topic, "/compressed") || ends_with(topic, "/compressedDepth");
}

const std::string& topic_of(const Ros2CameraSettings& settings, FramePart part) {
  switch (part) {
    case FramePart::points:
      return settings.points;
    case FramePart::color:
      return settings.color;
    case FramePart::labels:
      return settings.labels;
    case FramePart::confidences:
      return settings.confidences;
    default:
      return settings.depth;
  }
}

std::vector<FramePart> parts_of(const Ros2CameraSettings& settings) {
  std::vector<FramePart> parts = {FramePart::points};
  if (settings.points.empty()) parts = {FramePart::depth, FramePart::color};
  if (!settings.labels.empty()) parts.push_back(FramePart::labels);
  if (!settings.confidences.empty()) parts.push_back(FramePart::confidences);
  return parts;
}

std::string_view type_of(FramePart part, const std::string& topic) {
  if (part == FramePart::points) return sensor_msgs::PointCloud2::kType;
  return is_compressed(topic) ? sensor_msgs::CompressedImage::kType : sensor_msgs::Image::kType;
}

/// What keeps a topic's publishers from being heard.
std::string odd_publishers(const Node& node, const std::string& topic, std::string_view type,
                           bool reliable) {
  const auto publishers = node.publishers_of(topic);
  if (publishers.empty()) return "nobody publishes it";
  const auto fits = [&](const Endpoint& endpoint) { return endpoint.type == dds_type_name(type); };
  if (std::none_of(publishers.begin(), publishers.end(), fits)) {
    return "its type is " + ros_type_name(publishers.front().type) + ", expected " +
           std::string(type);
  }
  const auto reaches = [&](const Endpoint& endpoint) {
    return fits(endpoint) && (endpoint.qos.reliable || !reliable);
  };
  if (std::none_of(publishers.begin(), publishers.end(), reaches)) {
    return "it is published best effort: camera.reliable must be false";
  }
  return "";
}

CameraFeed::Parts feed_parts(const Node& node, const Ros2CameraSettings& settings,
                             const CameraSurroundings& around) {
  CameraFeed::Parts parts;
  parts.intake.parts = parts_of(settings);
  parts.intake.needs_info = settings.points.empty();
  parts.intake.sync.max_difference = nanoseconds(settings.max_difference_s);
  parts.assembly = assembly_options(settings.color, settings.depth);
  parts.assembly.min_confidence = settings.min_confidence;
  parts.assembly.min_range_m = around.min_range_m;
  parts.assembly.max_range_m = around.max_range_m;
  parts.topic = [settings](FramePart part) { return topic_of(settings, part); };
  parts.info_topic = settings.info;
  parts.odd_publishers = [&node, settings](const std::string& topic) -> std::string {
    for (const auto& [name, type] : Ros2Camera::topics(settings)) {
      if (name == topic) return odd_publishers(node, topic, type, settings.reliable);
    }
    return "";
  };
  parts.mission_time_s = around.mission_time_s;
  parts.alive = around.alive;
  return parts;
}

}  // namespace

std::vector<Ros2Camera::Topic> Ros2Camera::topics(const Ros2CameraSettings& settings) {
  std::vector<Topic> topics;
  for (const FramePart part : parts_of(settings)) {
    const std::string& topic = topic_of(settings, part);
    topics.push_back({topic, std::string(type_of(part, topic))});
  }
  if (settings.points.empty()) {
    topics.push_back({settings.info, std::string(sensor_msgs::CameraInfo::kType)});
  }
  return topics;
}

Expected<std::unique_ptr<Ros2Camera>> Ros2Camera::make(Node& node,
                                                       const Ros2CameraSettings& settings,
                                                       const CameraSurroundings& around) {
  std::unique_ptr<Ros2Camera> camera(new Ros2Camera(around));
  std::unique_ptr<FramePoses> poses =
      settings.pose == "tf" ? poses_of_tf(around.robot, camera->tf_, settings.world_frame,
                                          settings.optical_frame, around.trolley)
                            : poses_of_joints(around.robot, around.joints, around.trolley);
  camera->feed_ = std::make_unique<CameraFeed>(settings, feed_parts(node, settings, around),
                                               around.joints, std::move(poses));
  if (auto subscribed = camera->subscribe(node, settings); !subscribed) {
    return fail_in("camera", subscribed.error());
  }
  return camera;
}

Ros2Camera::~Ros2Camera() = default;

template <class Message>
Expected<void> Ros2Camera::subscribe_as(Node& node, FramePart part, const std::string& topic,
                                        const Qos& qos) {
  auto made = node.subscribe<Message>(topic, qos, [this, part](Message&& message, const Guid&) {
    feed_->intake().add(part, std::move(message), around_.now());
  });
  if (!made) return tl::unexpected(made.error());
  subscriptions_.push_back(std::move(*made));
  return {};
}

Expected<void> Ros2Camera::subscribe_part(Node& node, FramePart part, const std::string& topic,
                                          const Qos& qos) {
  if (part == FramePart::points) {
    return subscribe_as<sensor_msgs::PointCloud2>(node, part, topic, qos);
  }
  if (is_compressed(topic)) {
    return subscribe_as<sensor_msgs::CompressedImage>(node, part, topic, qos);
  }
  return subscribe_as<sensor_msgs::Image>(node, part, topic, qos);
}

Expected<void> Ros2Camera::subscribe(Node& node, const Ros2CameraSettings& settings) {
  const Qos qos{settings.reliable, false, 5};
  for (const FramePart part : parts_of(settings)) {
    auto made = subscribe_part(node, part, topic_of(settings, part), qos);
    if (!made) return made;
  }
  if (settings.points.empty()) {  // a cloud says its camera by itself
    auto made = node.subscribe<sensor_msgs::CameraInfo>(
        settings.info, qos, [this](sensor_msgs::CameraInfo&& info, const Guid&) {
          feed_->intake().set_info(std::move(info));
        });
    if (!made) return tl::unexpected(made.error());
    subscriptions_.push_back(std::move(*made));
  }
  if (settings.pose != "tf") return {};
  for (const bool is_static : {false, true}) {
    auto made = node.subscribe<tf2_msgs::TFMessage>(
        is_static ? "/tf_static" : "/tf", is_static ? Qos{true, true, 100} : kTfQos,
        [this, is_static](tf2_msgs::TFMessage&& message, const Guid&) {
          tf_.add(message, is_static);
        });
    if (!made) return tl::unexpected(made.error());
    subscriptions_.push_back(std::move(*made));
  }
  return {};
}

Expected<RgbdFrame> Ros2Camera::capture() {
  auto timed = feed_->capture();
  if (!timed) return fail_in("camera", timed.error());
  constexpr std::size_t kKept = 1000;
  const std::lock_guard lock(mutex_);
  if (latencies_.waited_s.size() < kKept) {
    latencies_.waited_s.push_back(timed->waited_s);
    latencies_.decoded_s.push_back(timed->decoded_s);
  }
  intrinsics_ = timed->frame.intrinsics;
  return std::move(timed->frame);
}

Expected<void> Ros2Camera::stream(double hz) {
  const auto info = feed_->intake().info();
  const std::lock_guard lock(mutex_);
  hz_ = hz;
  due_ = 0;
  if (const auto newest = around_.joints.newest()) streamed_ = *newest;
  if (!intrinsics_) {  // no frame yet: what the driver says will do for reckoning blur
    intrinsics_.emplace();
    if (info && info->k[0] > 0.0) {
      *intrinsics_ = {static_cast<int>(info->width),
                      static_cast<int>(info->height),
                      info->k[0],
                      info->k[4],
                      info->k[2],
                      info->k[5],
                      around_.min_range_m,
                      around_.max_range_m};
    }
  }
  return {};
}

Expected<std::vector<StreamedFrame>> Ros2Camera::arrived() {
  std::vector<StreamedFrame> frames;
  const std::lock_guard lock(mutex_);
  if (hz_ <= 0.0) return frames;
  const Stamp period = nanoseconds(1.0 / hz_);
  for (const CameraFeed::Messages& messages : feed_->messages_since(streamed_)) {
    const Stamp stamp = feed_->stamp_of(*messages);
    if (trolley_lags(stamp)) break;
    streamed_ = stamp;
    if (stamp + period / 10 < due_) continue;  // cameras are not that punctual
    due_ = std::max(due_, stamp - period) + period;
    if (auto frame = streamed(messages)) frames.push_back(std::move(*frame));
  }
  return frames;
}

/// Where the trolley was then will be known soon. One that says nothing for long stands.
bool Ros2Camera::trolley_lags(Stamp stamp) const {
  constexpr double kSoon_s = 0.5;
  if (!around_.trolley_known_until) return false;
  const auto known = around_.trolley_known_until();
  return known && *known < stamp && stamp - *known < nanoseconds(kSoon_s);
}

/// Nothing: where the camera was is not known. The lock is held.
std::optional<StreamedFrame> Ros2Camera::streamed(const CameraFeed::Messages& messages) {
  constexpr double kTwistSpan_s = 0.02;
  const Stamp stamp = feed_->stamp_of(*messages);
  const std::string& id = feed_->frame_id(*messages);
  const auto pose = feed_->pose_at(stamp, id);
  const auto before = feed_->pose_at(stamp - nanoseconds(kTwistSpan_s), id);
  const auto q = around_.joints.at(stamp);
  if (!pose || !before || !q) return std::nullopt;
  StreamedFrame frame;
  frame.time_s = around_.mission_time_s(stamp);
  const std::chrono::duration<double> ago = FrameIntake::Steady::now() - messages->arrived;
  frame.arrived_s = around_.mission_time_s(around_.now()) - ago.count();
  frame.T_world_camera = *pose;
  frame.twist = twist_between(*before, *pose, kTwistSpan_s);
  frame.q = arm_configuration(around_.robot, around_.joints, *q);
  frame.trolley = around_.trolley(stamp);
  frame.intrinsics = *intrinsics_;
  frame.images = [this, messages]() -> Expected<RgbdFrame> {
    auto timed = feed_->decode(*messages);
    if (!timed) return tl::unexpected(timed.error());
    return std::move(timed->frame);
  };
  return frame;
}

Ros2Camera::Latencies Ros2Camera::latencies() const {
  const std::lock_guard lock(mutex_);
  return latencies_;
}

}  // namespace canopeer::ros
