#include "canopeer/ros2/check/check_bench.h"

#include "canopeer/ros2/node_of_settings.h"

namespace canopeer::ros {
namespace {

constexpr double kRemembered_s = 600.0;

TrolleyState believed_place(const Ros2Settings& settings, const MissionFile& file) {
  const auto& start = settings.trolley.start_m;
  if (start.size() == 2) return {start[0], start[1]};
  return file.mission.segments.front().trolley;
}

Expected<void> listen_to_tf(CheckBench& bench) {
  for (const bool is_static : {false, true}) {
    auto made = bench.node->subscribe<tf2_msgs::TFMessage>(
        is_static ? "/tf_static" : "/tf", is_static ? Qos{true, true, 100} : kTfQos,
        [&bench, is_static](tf2_msgs::TFMessage&& message, const Guid&) {
          bench.tf.add(message, is_static);
        });
    if (!made) return tl::unexpected(made.error());
    bench.subscriptions.push_back(std::move(*made));
  }
  return {};
}

Expected<void> listen_to_info(CheckBench& bench) {
  const Ros2CameraSettings& camera = bench.settings.camera;
  if (!camera.points.empty() || camera.info.empty()) return {};
  auto made = bench.node->subscribe<sensor_msgs::CameraInfo>(
      camera.info, {camera.reliable, false, 5}, [&bench](sensor_msgs::CameraInfo&&, const Guid&) {
        const std::lock_guard lock(bench.mutex);
        ++bench.infos;
      });
  if (!made) return tl::unexpected(made.error());
  bench.subscriptions.push_back(std::move(*made));
  return {};
}

Expected<void> open_joints(CheckBench& bench) {
  const auto now = [&bench] { return bench.clock->now(); };
  std::vector<JointHistory*> histories = bench.sense.by_joint_states();
  histories.push_back(&bench.joints);
  bench.listener = std::make_unique<JointListener>(bench.settings.arm.joint_names, histories, now,
                                                   bench.settings.arm.start_tolerance_rad);
  const auto& topics = bench.settings.arm.joint_states;
  if (auto ok = bench.listener->listen(*bench.node, topics); !ok) return ok;
  bench.joint_ear = std::make_unique<JointEar>(now);
  if (auto ok = bench.joint_ear->listen(*bench.node, topics); !ok) return ok;
  return bench.sense.listen(*bench.node, *bench.clock);
}

Expected<void> open_machines(CheckBench& bench, const PersonHooks& person) {
  auto arm = Ros2Arm::make({*bench.node, bench.robot, bench.joints, *bench.clock, person,
                            [&bench] { return bench.listener->contradiction(); }},
                           bench.settings);
  if (!arm) return tl::unexpected(arm.error());
  bench.arm = std::move(*arm);
  auto trolley = Ros2Trolley::make({*bench.node, bench.robot, bench.sense, *bench.clock, person,
                                    [&bench] { return bench.arm->fresh(); }},
                                   *bench.arm, bench.settings, [] {});
  if (!trolley) return tl::unexpected(trolley.error());
  bench.trolley = std::move(*trolley);
  const CameraIntrinsics& asked = bench.file.simulation.camera;
  auto camera = Ros2Camera::make(
      *bench.node, bench.settings.camera,
      {bench.robot, bench.joints, [&bench](Stamp stamp) { return bench.sense.at(stamp); },
       [&bench] { return bench.clock->now(); },
       [&bench](Stamp stamp) { return bench.clock->mission_time_s(stamp); }, asked.min_range_m,
       asked.max_range_m, kRemembered_s});
  if (!camera) return tl::unexpected(camera.error());
  bench.camera = std::move(*camera);
  return {};
}

}  // namespace

CheckBench::CheckBench(const MissionFile& from, const RobotModel& model)
    : file(from),
      robot(model),
      settings(from.ros2.value_or(Ros2Settings())),
      joints(model.setup().arm_joints, kRemembered_s),
      sense(model, settings.trolley, believed_place(settings, from)) {}

Expected<std::unique_ptr<CheckBench>> CheckBench::open(const MissionFile& file,
                                                       const RobotModel& robot,
                                                       std::function<bool()> stop_asked) {
  auto bench = std::make_unique<CheckBench>(file, robot);
  if (auto ok = bench->settings.validate(); !ok) return tl::unexpected(ok.error());
  auto node = Node::make(node_of(bench->settings));
  if (!node) return tl::unexpected(node.error());
  bench->node = std::move(*node);
  if (bench->settings.use_sim_time) {
    auto clock = RosClock::of_simulation(*bench->node);
    if (!clock) return tl::unexpected(clock.error());
    bench->clock = std::move(*clock);
  } else {
    bench->clock = std::make_unique<RosClock>();
  }
  PersonHooks person;
  person.stop_asked = std::move(stop_asked);
  if (auto ok = bench->node_ear.listen(*bench->node); !ok) return tl::unexpected(ok.error());
  if (auto ok = listen_to_tf(*bench); !ok) return tl::unexpected(ok.error());
  if (auto ok = listen_to_info(*bench); !ok) return tl::unexpected(ok.error());
  if (auto ok = open_joints(*bench); !ok) return tl::unexpected(ok.error());
  if (auto ok = open_machines(*bench, person); !ok) return tl::unexpected(ok.error());
  return bench;
}

void CheckBench::count_from_now() {
  joint_ear->count_from_now();
  counted_before.clear();
  std::vector<std::int64_t> counts;
  for (const ListenedTopic& topic : camera_topics()) counts.push_back(topic.count);
  counted_before = std::move(counts);
}

std::vector<ListenedTopic> CheckBench::camera_topics() const {
  std::vector<ListenedTopic> topics;
  const auto& parts = camera->feed().intake().options().parts;
  const auto asked = Ros2Camera::topics(settings.camera);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    ListenedTopic topic;
    topic.topic = asked[i].name;
    topic.type = asked[i].type;
    topic.reliable = settings.camera.reliable;
    if (i < parts.size()) {
      const auto heard = camera->feed().intake().heard(parts[i]);
      topic.what = name_of(parts[i]);
      topic.count = heard.count;
      topic.encoding = heard.encoding;
      topic.octets = heard.octets;
    } else {
      const std::lock_guard lock(mutex);
      topic.what = "info";
      topic.count = infos;
    }
    if (i < counted_before.size()) topic.count -= counted_before[i];
    topic.key = "ros2.camera." + topic.what;
    topics.push_back(std::move(topic));
  }
  return topics;
}

std::optional<double> CheckBench::image_age_s() const {
  const auto& intake = camera->feed().intake();
  return intake.heard(intake.options().parts.front()).least_age_s;
}

std::string CheckBench::frame_id() const {
  const auto& intake = camera->feed().intake();
  return intake.heard(intake.options().parts.front()).frame_id;
}

}  // namespace canopeer::ros
