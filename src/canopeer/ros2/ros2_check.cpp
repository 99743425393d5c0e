#include "canopeer/ros2/ros2_check.h"

#include <chrono>
#include <thread>

#include "canopeer/ros2/check/check_bench.h"
#include "canopeer/ros2/check/clock_judgement.h"
#include "canopeer/ros2/check/findings.h"
#include "canopeer/ros2/check/frame_judgement.h"
#include "canopeer/ros2/check/joint_judgement.h"
#include "canopeer/ros2/check/motion_check.h"
#include "canopeer/ros2/check/peer_judgement.h"
#include "canopeer/ros2/presence/presence.h"

namespace canopeer {
namespace ros {
namespace {

/// What a mission waits for, so that rates are not measured of what is only just found.
std::vector<std::string> not_found_yet(CheckBench& bench) {
  std::vector<std::string> missing;
  const auto miss = [&](std::string text) {
    if (!text.empty()) missing.push_back(std::move(text));
  };
  for (const std::string& topic : bench.settings.arm.joint_states) {
    miss(missing_topic(*bench.node, topic, "sensor_msgs/msg/JointState"));
  }
  for (const auto& topic : Ros2Camera::topics(bench.settings.camera)) {
    miss(missing_topic(*bench.node, topic.name, topic.type));
  }
  if (!bench.arm->ready()) {
    miss(missing_trajectory_action(*bench.node, bench.settings.arm.action));
  }
  return missing;
}

void judge_joints(CheckBench& bench, double listened_s, Findings& findings) {
  std::string odd;
  for (const std::string& topic : bench.settings.arm.joint_states) {
    const std::string why = missing_topic(*bench.node, topic, "sensor_msgs/msg/JointState");
    if (!why.empty()) odd += (odd.empty() ? "" : "; ") + why;
  }
  std::vector<std::string> trolley;
  for (const JointHistory* history : bench.sense.by_joint_states()) {
    trolley.insert(trolley.end(), history->joints().begin(), history->joints().end());
  }
  const HeardJoints heard = bench.joint_ear->heard();
  judge_joint_states(bench.robot, bench.settings.arm, trolley, heard, listened_s, odd, findings);
  judge_speakers(bench.robot, bench.settings.arm, trolley, heard, bench.node_ear.nodes(), findings);
}

void judge_machines(CheckBench& bench, Findings& findings) {
  const std::string action = missing_trajectory_action(*bench.node, bench.settings.arm.action);
  const std::string& name = bench.settings.arm.action;
  if (bench.arm->ready()) {
    findings.ok("arm", name + " is served");
  } else if (bench.settings.dry_run) {
    findings.notice("arm", action + "; not needed in a dry run");
  } else {
    findings.wrong("arm", (action.empty() ? name + " does not answer" : action) +
                              " (ros2.arm.action); is the controller active?");
  }
  const Participant& domain = bench.node->participant();
  judge_action_servers(bench.node->resolve(name), domain.peers(), domain.endpoints(), findings);
  const std::string& safety = bench.settings.arm.safety_mode;
  if (!safety.empty()) {
    const std::string why = missing_topic(*bench.node, safety, "ur_dashboard_msgs/msg/SafetyMode");
    if (why.empty()) findings.ok("safety mode", safety);
    if (!why.empty()) findings.wrong("safety mode", why + " (ros2.arm.safety_mode)");
  }
  std::vector<std::string> missing = bench.trolley->missing();
  for (const std::string& axis : bench.sense.silent(1e9)) missing.push_back("where it is: " + axis);
  for (const std::string& what : missing) findings.wrong("trolley", what);
  if (missing.empty()) findings.ok("trolley", in_words(bench.sense.now(), bench.robot));
}

void judge_camera(CheckBench& bench, double listened_s, Findings& findings) {
  const auto topics = bench.camera_topics();
  const auto endpoints = bench.node->participant().endpoints();
  for (const ListenedTopic& topic : topics) {
    judge_topic(topic, bench.node->publishers_of(topic.topic),
                topics_of_type(endpoints, topic.type), listened_s, findings);
  }
  if (const auto buffers = receive_buffers()) judge_buffers(topics, *buffers, findings);
  judge_clocks(bench.joint_ear->heard().least_age_s, bench.image_age_s(),
               bench.settings.camera.time_offset_s, findings);
  judge_frame(bench.camera->feed().capture(), bench.file.simulation.camera, findings);
  judge_tf(bench.tf, bench.robot, bench.arm->configuration(), bench.settings.camera,
           bench.frame_id(), findings);
}

/// Counts for a while, and on until something came of everything that somebody publishes. How long,
/// s.
double listen(CheckBench& bench, const Ros2CheckOptions& options,
              const std::function<bool()>& stop) {
  using Steady = std::chrono::steady_clock;
  const auto began = Steady::now();
  const auto passed_s = [&] {
    return std::chrono::duration<double>(Steady::now() - began).count();
  };
  bench.count_from_now();
  const auto silent = [&] {
    for (const ListenedTopic& topic : bench.camera_topics()) {
      if (topic.count == 0 && !bench.node->publishers_of(topic.topic).empty()) return true;
    }
    return false;
  };
  const double longest_s = options.listen_s + bench.settings.discovery_s;
  while (!stop() && (passed_s() < options.listen_s || (silent() && passed_s() < longest_s))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return passed_s();
}

void judge_all(CheckBench& bench, const Ros2CheckOptions& options, Findings& findings) {
  const auto stop = [&] { return options.stop_asked && options.stop_asked(); };
  // What is missing then is said below.
  static_cast<void>(
      wait_for_presence([&] { return not_found_yet(bench); }, bench.settings.discovery_s, stop));
  const double listened_s = listen(bench, options, stop);
  judge_peers(bench.node->participant().peers(), bench.node_ear.nodes(), bench.node->options(),
              findings);
  judge_sim_time(bench.settings.use_sim_time, !bench.node->publishers_of("/clock").empty(),
                 bench.clock->running(), findings);
  judge_joints(bench, listened_s, findings);
  judge_machines(bench, findings);
  judge_camera(bench, listened_s, findings);
  if (!options.move || stop()) return;
  if (findings.any_wrong()) {
    findings.notice("motions", "none while something is wrong");
  } else {
    check_by_moving(bench, options.looks, findings);
  }
}

}  // namespace
}  // namespace ros

Expected<std::vector<Ros2Finding>> check_ros2_robot(const MissionFile& file,
                                                    const RobotModel& robot,
                                                    const Ros2CheckOptions& options) {
  auto bench = ros::CheckBench::open(file, robot, options.stop_asked);
  if (!bench) return fail_in("ros2", bench.error());
  ros::Findings findings(options.on_finding);
  ros::judge_all(**bench, options, findings);
  return findings.all();
}

}  // namespace canopeer
