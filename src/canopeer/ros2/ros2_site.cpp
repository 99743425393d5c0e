#include "canopeer/ros2/ros2_site.h"

#include <atomic>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/arm/ros2_arm.h"
#include "canopeer/ros2/camera/ros2_camera.h"
#include "canopeer/ros2/node_of_settings.h"
#include "canopeer/ros2/out/ros2_output.h"
#include "canopeer/ros2/presence/presence.h"
#include "canopeer/ros2/time/figure.h"
#include "canopeer/ros2/trolley/ros2_trolley.h"

namespace canopeer {
namespace ros {
namespace {

Ros2Settings settings_of(const MissionFile& file) { return file.ros2.value_or(Ros2Settings()); }

/// Where the trolley is believed to stand at first.
TrolleyState first_place(const Ros2Settings& settings, const MissionFile& file) {
  const std::vector<double>& start = settings.trolley.start_m;
  if (start.size() == 2) return {start[0], start[1]};
  return file.mission.segments.front().trolley;
}

/// The trolley, and a frame after a push by hand, which says where it stands.
class PlacingTrolley : public Trolley {
 public:
  PlacingTrolley(Ros2Trolley& trolley, Camera& camera) : trolley_(trolley), camera_(camera) {}
  void watch_map(const VoxelMap* map) { map_ = map; }
  TrolleyState state() const override { return trolley_.state(); }
  Expected<void> move_to(const TrolleyState& goal) override {
    return placed(trolley_.move_to(goal));
  }
  Expected<double> set_out(const Drive& drive) override { return trolley_.set_out(drive); }
  bool knows_where_it_drives() const override { return trolley_.knows_where_it_drives(); }
  Expected<void> arrive() override { return placed(trolley_.arrive()); }

 private:
  Expected<void> placed(const Expected<void>& moved) {
    if (!moved || !trolley_.in_doubt()) return moved;
    auto frame = camera_.capture();
    if (!frame) return fail_in("camera", frame.error());
    return trolley_.check_place(map_, *frame);
  }

  Ros2Trolley& trolley_;
  Camera& camera_;
  const VoxelMap* map_ = nullptr;
};

/// The site's steering, which knows whether the mission was told of a stop.
class HeardSteering : public Steering {
 public:
  HeardSteering(Steering& steering, std::function<bool()> stop_asked)
      : steering_(steering), stop_asked_(std::move(stop_asked)) {}
  SteeringWord ask(const SteeringPoint& point) override {
    const bool stop = stop_asked_();  // first: what is said later is for the next question
    SteeringWord word = steering_.ask(point);
    if (!stop) return word;
    stop_heard_ = true;
    if (word.kind == SteeringWord::Kind::stop) return word;
    return {SteeringWord::Kind::stop, "person", ""};
  }
  bool stop_heard() const { return stop_heard_; }

 private:
  Steering& steering_;
  const std::function<bool()> stop_asked_;
  std::atomic<bool> stop_heard_{false};
};

class Ros2Site : public Site {
 public:
  explicit Ros2Site(const SiteRequest& request)
      : request_(request),
        settings_(settings_of(request.file)),
        joints_(request.robot.setup().arm_joints),
        sense_(request.robot, settings_.trolley, first_place(settings_, request.file)),
        judge_(request.robot) {}

  Expected<void> open();

  Ports ports() override { return {clock_.get(), arm_.get(), placing_.get(), camera_.get()}; }
  const ExactChecker& judge() const override { return judge_; }
  void watch_map(const VoxelMap* map) override { placing_->watch_map(map); }
  std::shared_ptr<Watcher> watcher() override { return output_->watcher(); }
  Steering* steering() override { return steering_.get(); }
  void end_motion() override { arm_->end_motion(); }
  void results_in(const std::filesystem::path& out) override { output_->save_into(out); }

 private:
  Expected<void> open_clock();
  Expected<void> open_ports();
  Expected<void> open_output();
  Expected<void> wait_until_all_is_there();
  [[nodiscard]] std::vector<std::string> missing();
  void miss_joint_states(std::vector<std::string>& missing);
  [[nodiscard]] PersonHooks person();
  [[nodiscard]] bool stop_asked() const {
    return (request_.callbacks.stop_asked && request_.callbacks.stop_asked()) ||
           (output_ != nullptr && output_->stop_asked());
  }
  [[nodiscard]] std::optional<RobotPlace> place() const;
  void tell(const std::string& text) const;

  const SiteRequest request_;
  const Ros2Settings settings_;
  std::shared_ptr<Node> node_;
  std::shared_ptr<RosClock> clock_;
  JointHistory joints_;
  TrolleySense sense_;
  ExactChecker judge_;
  std::unique_ptr<JointListener> listener_;
  std::unique_ptr<Ros2Arm> arm_;
  std::unique_ptr<Ros2Trolley> trolley_;
  std::unique_ptr<Ros2Camera> camera_;
  std::unique_ptr<PlacingTrolley> placing_;
  std::unique_ptr<Ros2Output> output_;  // late: it asks for what is above
  std::unique_ptr<HeardSteering> steering_;
};

Expected<void> Ros2Site::open() {
  if (auto ok = settings_.validate(); !ok) return ok;
  auto node = Node::make(node_of(settings_));
  if (!node) return tl::unexpected(node.error());
  node_ = std::move(*node);
  if (auto ok = open_clock(); !ok) return ok;
  if (auto ok = open_output(); !ok) return ok;
  if (auto ok = open_ports(); !ok) return ok;
  return wait_until_all_is_there();
}

Expected<void> Ros2Site::open_clock() {
  if (!settings_.use_sim_time) {
    clock_ = std::make_shared<RosClock>();
    return {};
  }
  auto clock = RosClock::of_simulation(*node_);
  if (!clock) return tl::unexpected(clock.error());
  clock_ = std::move(*clock);
  return {};
}

Expected<void> Ros2Site::open_output() {
  auto output = Ros2Output::make(
      {node_, clock_, request_.file, settings_, request_.robot, [this] { return place(); }});
  if (!output) return tl::unexpected(output.error());
  output_ = std::move(*output);
  steering_ = std::make_unique<HeardSteering>(output_->steering(), [this] { return stop_asked(); });
  return {};
}

Expected<void> Ros2Site::open_ports() {
  std::vector<JointHistory*> histories = sense_.by_joint_states();
  histories.push_back(&joints_);
  listener_ = std::make_unique<JointListener>(
      settings_.arm.joint_names, histories, [this] { return clock_->now(); },
      settings_.arm.start_tolerance_rad);
  if (auto ok = listener_->listen(*node_, settings_.arm.joint_states); !ok) return ok;
  if (auto ok = sense_.listen(*node_, *clock_); !ok) return ok;

  auto arm = Ros2Arm::make({*node_, request_.robot, joints_, *clock_, person(),
                            [this] { return listener_->contradiction(); }},
                           settings_);
  if (!arm) return tl::unexpected(arm.error());
  arm_ = std::move(*arm);
  auto trolley = Ros2Trolley::make(
      {*node_, request_.robot, sense_, *clock_, person(), [this] { return arm_->fresh(); }}, *arm_,
      settings_, [this] {
        const auto now = joints_.newest();
        if (now) camera_->feed().not_before(*now);
      });
  if (!trolley) return tl::unexpected(trolley.error());
  trolley_ = std::move(*trolley);

  const CameraIntrinsics& asked = request_.file.simulation.camera;
  CameraSurroundings around{request_.robot,
                            joints_,
                            [this](Stamp stamp) { return sense_.at(stamp); },
                            [this] { return clock_->now(); },
                            [this](Stamp stamp) { return clock_->mission_time_s(stamp); },
                            asked.min_range_m,
                            asked.max_range_m};
  around.alive = [this] { return arm_->fresh(); };
  around.trolley_known_until = [this] { return sense_.known_until(); };
  auto camera = Ros2Camera::make(*node_, settings_.camera, around);
  if (!camera) return fail_in("camera", camera.error());
  camera_ = std::move(*camera);
  placing_ = std::make_unique<PlacingTrolley>(*trolley_, *camera_);
  return {};
}

PersonHooks Ros2Site::person() {
  PersonHooks person;
  person.stop_asked = [this] { return stop_asked(); };
  person.going_home = [this] { return steering_->stop_heard(); };
  person.stop_at_once = request_.callbacks.stop_at_once;
  person.may_move = [this, person](const std::string& motion) {
    // Who has stopped the run may still want the arm to go home.
    return output_->may_move(motion, [&] { return person.arm_stops(); });
  };
  person.say = [this](const std::string& text) { tell(text); };
  return person;
}

void Ros2Site::tell(const std::string& text) const {
  output_->tell(text);
  if (request_.callbacks.on_message) request_.callbacks.on_message(text);
}

std::optional<RobotPlace> Ros2Site::place() const {
  const auto positions = joints_.last();
  if (!positions || joints_.silence_s() > settings_.arm.max_silence_s) return std::nullopt;
  return RobotPlace{Eigen::Map<const Eigen::VectorXd>(positions->data(), request_.robot.dof()),
                    sense_.now()};
}

void Ros2Site::miss_joint_states(std::vector<std::string>& missing) {
  const auto silent = joints_.silent(settings_.arm.max_silence_s);
  if (silent.empty()) return;
  std::string text = "joint states of";
  for (const std::string& joint : silent) text += " " + joint;
  for (const std::string& topic : settings_.arm.joint_states) {
    const std::string why = missing_topic(*node_, topic, "sensor_msgs/msg/JointState");
    if (!why.empty()) text += "; " + why;
  }
  const auto strangers = listener_->strangers();
  if (!strangers.empty()) {
    text += "; said in their place are";
    for (const std::string& joint : strangers) text += " " + joint;
    text += " (ros2.arm.joint_names)";
  }
  missing.push_back(std::move(text));
}

std::vector<std::string> Ros2Site::missing() {
  std::vector<std::string> missing;
  const auto miss = [&](std::string text) {
    if (!text.empty()) missing.push_back(std::move(text));
  };
  if (!clock_->running()) miss("/clock (ros2.use_sim_time): nobody says the time");
  miss_joint_states(missing);
  if (!settings_.dry_run && !arm_->ready()) {
    miss(missing_trajectory_action(*node_, settings_.arm.action));
  }
  if (!settings_.arm.safety_mode.empty()) {
    miss(missing_topic(*node_, settings_.arm.safety_mode, "ur_dashboard_msgs/msg/SafetyMode"));
  }
  for (const Ros2Camera::Topic& topic : Ros2Camera::topics(settings_.camera)) {
    miss(missing_topic(*node_, topic.name, topic.type));
  }
  for (const std::string& axis : sense_.silent(1e9)) miss("where the trolley is: " + axis);
  if (!settings_.dry_run) {
    for (const std::string& what : trolley_->missing()) miss("for the trolley: " + what);
  }
  return missing;
}

Expected<void> Ros2Site::wait_until_all_is_there() {
  const auto still = wait_for_presence([this] { return missing(); }, settings_.discovery_s,
                                       [this] { return stop_asked(); });
  if (still.empty()) return {};
  if (stop_asked()) return fail("stopped while waiting for the robot");
  std::string text = "missing after " + figure(settings_.discovery_s, 0) + " s: ";
  for (std::size_t i = 0; i < still.size(); ++i) text += (i > 0 ? ". " : "") + still[i];
  return fail(text + ". " + who_is_there(*node_) + "; 'canopeer ros2 check' says more");
}

}  // namespace
}  // namespace ros

Expected<std::unique_ptr<Site>> make_ros2_site(const SiteRequest& request) {
  auto site = std::make_unique<ros::Ros2Site>(request);
  if (auto ok = site->open(); !ok) return fail_in("ros2", ok.error());
  return site;
}

void add_ros2_site(SiteRegistry& sites) {
  if (!sites.one_line("ros2").empty()) return;
  SiteManners manners;
  manners.realtime = true;
  manners.arm_speed = [](const MissionFile& file) {
    return ros::settings_of(file).arm.speed_scale;
  };
  const auto added = sites.add_with_manners("ros2", "a robot on ROS 2, as the mission's ros2 says",
                                            make_ros2_site, std::move(manners));
  CANOPEER_CHECK(added.has_value(), "its name is good and free");
}

}  // namespace canopeer
