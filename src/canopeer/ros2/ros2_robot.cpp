#include "canopeer/ros2/ros2_robot.h"

#include <cstdio>

#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"
#include "canopeer/ros2/node_of_settings.h"
#include "canopeer/ros2/out/robot_description_text.h"
#include "canopeer/ros2/robot/robot_camera.h"
#include "canopeer/ros2/robot/robot_control.h"

namespace canopeer {
namespace {

RgbdSensorOptions camera_of(const SimulationOptions& options) {
  RgbdSensorOptions sensor = options.sensor;
  sensor.intrinsics = options.camera;
  sensor.seed = options.seed;
  return sensor;
}

ros::SimulatedPlace first_place(const MissionFile& file, const RobotModel& robot) {
  const SegmentPlan& first = file.mission.segments.front();
  return {robot.home("side_" + std::to_string(first.side)), first.trolley};
}

}  // namespace

Expected<void> Ros2RobotOptions::validate() const {
  const auto within = [](double value, double min, double max) {
    return value >= min && value <= max;
  };
  if (!within(joint_rate_hz, 10.0, 1000.0)) return fail("joint rate: expected 10 ... 1000 Hz");
  if (!within(camera_rate_hz, 0.1, 60.0)) return fail("camera rate: expected 0.1 ... 60 Hz");
  if (!within(camera_latency_s, 0.0, 10.0)) return fail("camera latency: expected 0 ... 10 s");
  if (!within(sim_rate, 0.01, 100.0)) return fail("rate of the clock: expected 0.01 ... 100");
  if (auto ok = ros::check_color_encoding(color_encoding); !ok) return ok;
  return ros::check_depth_encoding(depth_encoding);
}

struct Ros2Robot::State {
  State(const MissionFile& file, const RobotModel& model, Scene world,
        const Ros2RobotOptions& options)
      : robot(model),
        scene(std::move(world)),
        renderer(scene),
        sensor(renderer, scene, camera_of(file.simulation)),
        judge(model, scene),
        clock(options.sim_time, options.sim_rate, faults),
        watch(judge) {}

  [[nodiscard]] Expected<void> start(const MissionFile& file, const Ros2RobotOptions& options);
  [[nodiscard]] Expected<void> offer_services();

  const RobotModel& robot;
  Scene scene;
  Renderer renderer;
  RgbdSensor sensor;
  MotionJudge judge;
  ros::RobotFaults faults;
  ros::RobotClock clock;
  ros::RobotHistory history;
  ros::MotionWatch watch;
  std::unique_ptr<ros::Node> node;
  ros::Publisher<ros::std_msgs::String> description;
  std::unique_ptr<ros::RobotControl> control;
  std::unique_ptr<ros::RobotCamera> camera;
  std::optional<ros::Server<ros::std_srvs::Trigger>> release;
  ros::Subscription heard_faults;  // last: what callbacks use goes after it
};

Expected<void> Ros2Robot::State::start(const MissionFile& file, const Ros2RobotOptions& options) {
  for (const std::string& fault : options.faults) {
    if (auto ok = faults.set(fault); !ok) return ok;
  }
  Ros2Settings names = file.ros2.value_or(Ros2Settings());
  names.node = options.node;
  auto made = ros::Node::make(node_of(names));
  if (!made) return tl::unexpected(made.error());
  node = std::move(*made);
  auto urdf = ros::robot_description_text(file.robot);
  if (!urdf) return tl::unexpected(urdf.error());
  auto said = node->advertise<ros::std_msgs::String>("/robot_description", ros::kLatchedQos);
  if (!said) return tl::unexpected(said.error());
  description = std::move(*said);
  description.publish({*urdf});
  auto controlled = ros::RobotControl::start({*node, robot, clock, faults, history, watch}, names,
                                             first_place(file, robot), options.joint_rate_hz,
                                             options.split_joint_states);
  if (!controlled) return tl::unexpected(controlled.error());
  control = std::move(*controlled);
  auto seen = ros::RobotCamera::make(*node, names.camera,
                                     {options.camera_rate_hz, options.camera_latency_s,
                                      options.color_encoding, options.depth_encoding},
                                     robot, sensor, history, clock, faults);
  if (!seen) return tl::unexpected(seen.error());
  camera = std::move(*seen);
  return offer_services();
}

Expected<void> Ros2Robot::State::offer_services() {
  using ros::std_srvs::Trigger;
  auto server = ros::Server<Trigger>::make(
      *node, "~/release", [this](Trigger::Request&&, const ros::Server<Trigger>::Reply& reply) {
        control->release();
        reply({true, "the arm takes goals again"});
      });
  if (!server) return tl::unexpected(server.error());
  release.emplace(std::move(*server));
  auto heard = node->subscribe<ros::std_msgs::String>(
      "~/fault", ros::kDefaultQos, [this](ros::std_msgs::String&& text, const ros::Guid&) {
        // Nobody is there to be told: it stays as it is.
        static_cast<void>(faults.set(text.data));
      });
  if (!heard) return tl::unexpected(heard.error());
  heard_faults = std::move(*heard);
  return {};
}

Ros2Robot::Ros2Robot(std::unique_ptr<State> state) : state_(std::move(state)) {}
Ros2Robot::~Ros2Robot() = default;

Expected<std::unique_ptr<Ros2Robot>> Ros2Robot::start(const MissionFile& file,
                                                      const RobotModel& robot, Scene scene,
                                                      const Ros2RobotOptions& options) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  auto state = std::make_unique<State>(file, robot, std::move(scene), options);
  if (auto ok = state->start(file, options); !ok) return tl::unexpected(ok.error());
  return std::unique_ptr<Ros2Robot>(new Ros2Robot(std::move(state)));
}

Expected<void> Ros2Robot::set_fault(std::string_view fault) { return state_->faults.set(fault); }

Ros2RobotReport Ros2Robot::report() {
  const auto arm = state_->control->arm_counts();
  const auto judged = state_->watch.counts();
  return {arm.goals,
          arm.refused,
          arm.arrived,
          arm.cut_short,
          judged.motions,
          judged.collisions,
          judged.plant_contacts,
          state_->camera->frames(),
          state_->control->longest_gap_s()};
}

std::vector<std::string> ros2_robot_faults() {
  std::vector<std::string> lines;
  for (const ros::FaultKind& kind : ros::fault_kinds()) {
    char text[200];
    std::string values(kind.values.empty() ? "" : ":");
    values += kind.values;
    std::snprintf(text, sizeof text, "%-32s %s", (std::string(kind.name) + values).c_str(),
                  std::string(kind.what).c_str());
    lines.emplace_back(text);
  }
  return lines;
}

}  // namespace canopeer
