#include "canopeer/ros2/check/joint_judgement.h"

#include <algorithm>
#include <cmath>

#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

const std::string kJointStates = "joint states";
const std::string kJointNames = "joint names";

std::string names_listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::vector<std::string> wanted_joints(const RobotModel& robot,
                                       const std::vector<std::string>& trolley) {
  std::vector<std::string> wanted = robot.setup().arm_joints;
  wanted.insert(wanted.end(), trolley.begin(), trolley.end());
  return wanted;
}

/// "/robot_driver", or what there is of one without a name.
std::string speaker_named(const Guid& writer,
                          const std::map<ParticipantId, std::set<std::string>>& nodes) {
  const auto named = nodes.find(participant_of(writer));
  if (named == nodes.end() || named->second.empty()) return "a node that tells no name";
  return names_listed({named->second.begin(), named->second.end()});
}

/// Names that were heard and that no joint of the description has.
std::vector<std::string> unmapped_names(const RobotModel& robot, const Ros2ArmSettings& settings,
                                        const HeardJoints& heard) {
  std::vector<std::string> unmapped;
  for (const auto& [name, position] : heard.positions) {
    const auto& joints = robot.description().joints;
    const bool known = std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) {
      return drivers_name(settings.joint_names, joint.name) == name;
    });
    if (!known) unmapped.push_back(name);
  }
  return unmapped;
}

void judge_names(const RobotModel& robot, const Ros2ArmSettings& settings,
                 const std::vector<std::string>& wanted, const HeardJoints& heard,
                 Findings& findings) {
  std::vector<std::string> missing;
  for (const std::string& joint : wanted) {
    const std::string name = drivers_name(settings.joint_names, joint);
    if (heard.positions.count(name) == 0) missing.push_back(name);
  }
  const auto unmapped = unmapped_names(robot, settings, heard);
  if (!missing.empty()) {
    std::string text = "missing: " + names_listed(missing);
    if (!unmapped.empty()) {
      text += "; said but unknown: " + names_listed(unmapped) +
              ": map the description's names to the driver's in ros2.arm.joint_names";
    }
    findings.wrong(kJointNames, text);
    return;
  }
  if (!unmapped.empty()) {
    findings.ok(kJointNames,
                "all " + std::to_string(wanted.size()) +
                    " are said; so are others, which are passed over: " + names_listed(unmapped));
    return;
  }
  findings.ok(kJointNames, "all " + std::to_string(wanted.size()) + " are said");
}

void judge_positions(const RobotModel& robot, const Ros2ArmSettings& settings,
                     const HeardJoints& heard, Findings& findings) {
  const std::string what = "joint positions";
  std::string bad;
  for (int j = 0; j < robot.dof(); ++j) {
    const std::string& joint = robot.setup().arm_joints[static_cast<std::size_t>(j)];
    const auto said = heard.positions.find(drivers_name(settings.joint_names, joint));
    if (said == heard.positions.end()) continue;
    const double q = said->second;
    if (!std::isfinite(q)) {
      bad += (bad.empty() ? "" : "; ") + joint + " is no number";
      continue;
    }
    const double lower = robot.limits().lower[j], upper = robot.limits().upper[j];
    const double spare = settings.start_tolerance_rad;
    if (robot.endless()[j] || (q >= lower - spare && q <= upper + spare)) continue;
    bad += (bad.empty() ? "" : "; ") + joint + " is at " + figure(q, 3) + ", limits are " +
           figure(lower, 3) + " ... " + figure(upper, 3);
    if (robot.arm_joint_type(j) == JointType::kRevolute && std::abs(q) > 6.5 * upper) {
      bad += " (degrees?)";
    }
  }
  if (bad.empty()) {
    findings.ok(what, "within the limits of the description");
  } else {
    findings.wrong(what, bad + ": move the arm by its pendant, or mend the description's limits");
  }
}

}  // namespace

void judge_joint_states(const RobotModel& robot, const Ros2ArmSettings& settings,
                        const std::vector<std::string>& trolley, const HeardJoints& heard,
                        double listened_s, const std::string& silent_why, Findings& findings) {
  int messages = 0;
  std::string rates;
  for (const std::string& topic : settings.joint_states) {
    const auto count = heard.messages.find(topic);
    const int of_topic = count == heard.messages.end() ? 0 : count->second;
    messages += of_topic;
    rates += (rates.empty() ? "" : ", ") + topic + " " + figure(of_topic / listened_s, 0) + " Hz";
  }
  if (messages == 0) {
    findings.wrong(
        kJointStates,
        rates + (silent_why.empty() ? ": somebody publishes, but nothing comes; a firewall?"
                                    : ": " + silent_why + "; is ros2.arm.joint_states right?"));
    return;
  }
  constexpr double kSlow_hz = 20.0;
  if (heard.without_stamp > 0) {
    findings.notice(kJointStates, rates + "; " + std::to_string(heard.without_stamp) +
                                      " have no stamp: the time they come in is taken, which makes "
                                      "poses of the moving camera worse");
  } else if (messages / listened_s < kSlow_hz) {
    findings.notice(kJointStates, rates +
                                      ": slow; raise the rate of joint_state_broadcaster, so "
                                      "that a stop is noticed soon");
  } else {
    findings.ok(kJointStates, rates);
  }
  judge_names(robot, settings, wanted_joints(robot, trolley), heard, findings);
  judge_positions(robot, settings, heard, findings);
}

void judge_speakers(const RobotModel& robot, const Ros2ArmSettings& settings,
                    const std::vector<std::string>& trolley, const HeardJoints& heard,
                    const std::map<ParticipantId, std::set<std::string>>& nodes,
                    Findings& findings) {
  const auto by_position = [](const auto& a, const auto& b) { return a.second < b.second; };
  for (const std::string& joint : wanted_joints(robot, trolley)) {
    const std::string name = drivers_name(settings.joint_names, joint);
    const auto said = heard.said_by.find(name);
    if (said == heard.said_by.end()) continue;
    const auto [least, most] =
        std::minmax_element(said->second.begin(), said->second.end(), by_position);
    if (!(most->second - least->second > settings.start_tolerance_rad)) continue;
    findings.wrong(kJointStates, name + " is at " + figure(least->second, 3) + " by " +
                                     speaker_named(least->first, nodes) + " and at " +
                                     figure(most->second, 3) + " by " +
                                     speaker_named(most->first, nodes) +
                                     ": stop one of them, or name the right one's topic in "
                                     "ros2.arm.joint_states");
    return;
  }
}

}  // namespace canopeer::ros
