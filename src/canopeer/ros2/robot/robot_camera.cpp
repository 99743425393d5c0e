#include "canopeer/ros2/robot/robot_camera.h"

#include <algorithm>
#include <numbers>

namespace canopeer::ros {
namespace {

/// A shift and a turn that no axis of the camera is alike to.
Pose mounting_error(double mm, double degrees) {
  Pose T = Pose::Identity();
  T.translation() = mm * 1e-3 * Vec3(0.8, -0.6, 0.0);
  const double angle = degrees * std::numbers::pi / 180.0;
  T.linear() = Eigen::AngleAxisd(angle, Vec3(0.6, 0.8, 0.0)).toRotationMatrix();
  return T;
}

}  // namespace

Expected<std::unique_ptr<RobotCamera>> RobotCamera::make(
    Node& node, const Ros2CameraSettings& names, const RobotCameraOptions& options,
    const RobotModel& robot, const RgbdSensor& sensor, const RobotHistory& history,
    const RobotClock& clock, const RobotFaults& faults) {
  if (auto ok = check_color_encoding(options.color_encoding); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = check_depth_encoding(options.depth_encoding); !ok)
    return tl::unexpected(ok.error());
  std::unique_ptr<RobotCamera> camera(
      new RobotCamera(options, robot, sensor, history, clock, faults));
  if (auto ok = camera->advertise(node, names); !ok) return tl::unexpected(ok.error());
  camera->worker_ =
      std::jthread([c = camera.get()](const std::stop_token& stop) { c->work(stop); });
  return camera;
}

RobotCamera::RobotCamera(const RobotCameraOptions& options, const RobotModel& robot,
                         const RgbdSensor& sensor, const RobotHistory& history,
                         const RobotClock& clock, const RobotFaults& faults)
    : options_(options),
      robot_(robot),
      sensor_(sensor),
      history_(history),
      clock_(clock),
      faults_(faults) {}

RobotCamera::~RobotCamera() = default;

Expected<void> RobotCamera::advertise(Node& node, const Ros2CameraSettings& names) {
  Expected<void> outcome;
  const auto offer = [&]<class Message>(Publisher<Message>& publisher, const std::string& topic) {
    if (topic.empty() || !outcome) return;
    auto made = node.advertise<Message>(topic, Qos{true, false, 2});
    if (made) {
      publisher = std::move(*made);
    } else {
      outcome = tl::unexpected(made.error());
    }
  };
  offer(color_, names.color);
  offer(depth_, names.depth);
  offer(info_, names.info);
  offer(labels_, names.labels);
  offer(points_, names.points);
  if (!outcome || names.color.empty()) return outcome;
  auto nonsense = node.dds_writer("rt" + node.resolve(names.color), dds_type<sensor_msgs::Image>(),
                                  kDefaultQos, "source=canopeer;");
  if (!nonsense) return tl::unexpected(nonsense.error());
  nonsense_ = std::move(*nonsense);
  return {};
}

bool RobotCamera::watched() const {
  return color_.readers() + depth_.readers() + labels_.readers() + points_.readers() > 0 &&
         !faults_.on(RobotFault::camera_silent) && !faults_.on(RobotFault::vanish);
}

void RobotCamera::work(const std::stop_token& stop) {
  const Stamp period = nanoseconds(1.0 / options_.rate_hz);
  Stamp exposure = clock_.now() + period;
  while (!stop.stop_requested()) {
    if (!to_send_.empty() && to_send_.front().due < exposure) {
      wait_until(to_send_.front().due, stop);
      send(to_send_.front());
      to_send_.pop_front();
      continue;
    }
    wait_until(exposure, stop);
    if (watched()) {
      if (auto shot = take(exposure)) to_send_.push_back(std::move(*shot));
    }
    // What could not be taken in time is left out, as by a camera.
    exposure += period * std::max<Stamp>(1, (clock_.now() - exposure) / period);
  }
}

void RobotCamera::wait_until(Stamp time, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto left = clock_.wall(time - clock_.now());
    if (left <= std::chrono::nanoseconds(0)) return;
    std::this_thread::sleep_for(std::min(left, std::chrono::nanoseconds(50'000'000)));
  }
}

std::optional<RobotCamera::Shot> RobotCamera::take(Stamp exposure) {
  // The joints' places around that time are known at the next tick of their control.
  std::optional<SimulatedPlace> place;
  for (int tries = 0; tries < 50 && !(place = history_.at(exposure)); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (!place) return {};
  Pose T_world_camera = robot_.T_world_base(place->trolley) * robot_.T_base_camera(place->q);
  if (const auto off = faults_.values(RobotFault::hand_eye)) {
    T_world_camera = T_world_camera * mounting_error((*off)[0], (*off)[1]);
  }
  const auto late = faults_.values(RobotFault::frames_delayed);
  const auto offset = faults_.values(RobotFault::time_offset);
  return Shot{exposure + nanoseconds(options_.latency_s + (late ? (*late)[0] : 0.0)),
              sensor_.capture(T_world_camera, taken_++),
              clock_.said(exposure + nanoseconds(offset ? (*offset)[0] : 0.0))};
}

void RobotCamera::send(Shot& shot) {
  if (faults_.on(RobotFault::malformed)) send_nonsense();
  const auto say = [&](const auto& publisher, auto make) {
    if (publisher.readers() == 0) return;
    auto message = make();
    message.header.stamp = shot.stamp;
    message.header.frame_id = robot_.setup().camera_frame;
    publisher.publish(message);
  };
  const RgbdFrame& frame = shot.frame;
  say(info_, [&] { return info_message(frame.intrinsics); });
  say(color_, [&] { return color_message(frame.color, options_.color_encoding); });
  say(depth_, [&] { return depth_message(frame.depth, options_.depth_encoding); });
  say(labels_, [&] { return label_message(frame.labels); });
  say(points_, [&] { return cloud_message(frame); });
  ++frames_;
}

/// An image that is cut short, and one that has fewer pixels than it says.
void RobotCamera::send_nonsense() {
  if (nonsense_ == nullptr) return;
  static_cast<void>(nonsense_->write(Payload{0, 1, 0, 0, 9, 9, 9}));
  sensor_msgs::Image small;
  small.width = small.height = 1'000'000;
  small.encoding = options_.color_encoding;
  small.step = 3'000'000;
  small.data.resize(10);
  static_cast<void>(nonsense_->write(to_cdr(small)));
}

}  // namespace canopeer::ros
