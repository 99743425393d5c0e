#include "canopeer/robot/kinematics/joint_drives.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "canopeer/base/exact_text.h"

namespace canopeer {
namespace {

bool turns_or_slides(const Joint& joint) {
  return joint.type == JointType::kRevolute || joint.type == JointType::kPrismatic;
}

bool moves_freely(const Joint& joint) {
  return joint.type == JointType::kPlanar || joint.type == JointType::kFloating;
}

/// One description at work.
class DriveFinder {
 public:
  DriveFinder(const RobotDescription& robot, const RobotSetup& setup)
      : robot_(robot), setup_(setup) {
    for (std::size_t i = 0; i < robot.joints.size(); ++i) index_.emplace(robot.joints[i].name, i);
    std::map<std::string, const Joint*> carried_by;
    for (const Joint& joint : robot.joints) carried_by.emplace(joint.child, &joint);
    for (std::string link = setup.camera_frame; link != setup.base_link;) {
      const auto it = carried_by.find(link);
      if (it == carried_by.end() || !before_camera_.insert(it->second->name).second) break;
      link = it->second->parent;
    }
    found_.of.resize(robot.joints.size());
  }

  JointDrives find() {
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      const Joint& joint = robot_.joints[i];
      if (joint.mimics.empty() || joint.type == JointType::kFixed) drive(joint, found_.of[i]);
    }
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      const Joint& joint = robot_.joints[i];
      if (!joint.mimics.empty() && joint.type != JointType::kFixed) follow(joint, found_.of[i]);
    }
    check_standing();
    return std::move(found_);
  }

 private:
  void problem(const std::string& text) { found_.problems.push_back(text); }
  void notice(const std::string& text) { found_.notices.push_back(text); }

  [[nodiscard]] int arm_index(const std::string& name) const {
    const auto it = std::find(setup_.arm_joints.begin(), setup_.arm_joints.end(), name);
    return it == setup_.arm_joints.end() ? -1 : static_cast<int>(it - setup_.arm_joints.begin());
  }
  /// The key that says what the joint does; empty: none does.
  [[nodiscard]] std::string role(const std::string& name) const {
    if (arm_index(name) >= 0) return "arm_joints";
    if (name == setup_.travel_joint) return "travel_joint";
    if (name == setup_.lift_joint) return "lift_joint";
    return {};
  }

  /// Of a joint that mimics none.
  void drive(const Joint& joint, JointDrive& own) {
    own.arm_joint = arm_index(joint.name);
    if (own.arm_joint >= 0) {
      own.kind = JointDrive::Kind::kArm;
    } else if (joint.name == setup_.travel_joint) {
      own.kind = JointDrive::Kind::kTravel;
    } else if (joint.name == setup_.lift_joint) {
      own.kind = JointDrive::Kind::kLift;
    } else if (turns_or_slides(joint)) {
      stand(joint, own);
    } else if (moves_freely(joint)) {
      place(joint, own);
    }
  }

  /// At what `joint` comes to through all the joints in between.
  void follow(const Joint& joint, JointDrive& own) {
    if (!turns_or_slides(joint)) {
      problem(joint_title(joint) + " mimics '" + joint.mimics +
              "', but only revolute, continuous and prismatic joints can");
      return;
    }
    if (const std::string key = role(joint.name); !key.empty()) {
      problem(joint_title(joint) + " mimics '" + joint.mimics + "': leave it out of " + key +
              ", it follows by itself");
    }
    double multiplier = 1.0;
    double offset = 0.0;
    const Joint* master = &joint;
    std::set<std::string> passed;
    while (!master->mimics.empty() && master->type != JointType::kFixed) {
      if (!passed.insert(master->name).second) {
        problem(joint_title(joint) + (master->mimics == joint.name && master == &joint
                                          ? " mimics itself"
                                          : " mimics '" + joint.mimics + "' in a circle"));
        return;
      }
      const auto it = index_.find(master->mimics);
      if (it == index_.end()) {
        if (master == &joint)
          problem(joint_title(joint) + " mimics '" + joint.mimics +
                  "', but there is no joint of that name");
        return;  // said of the one in between
      }
      offset += multiplier * master->offset;
      multiplier *= master->multiplier;
      master = &robot_.joints[it->second];
    }
    if (moves_freely(*master)) {
      problem(joint_title(joint) + " mimics '" + master->name +
              "', a planar or floating joint: it has no position to follow");
      return;
    }
    own = found_.of[index_.at(master->name)];
    own.follows = true;
    own.multiplier = multiplier;
    if (own.kind == JointDrive::Kind::kStands || multiplier == 0.0) {
      const double of_master = own.kind == JointDrive::Kind::kStands ? own.offset : 0.0;
      own = {};
      own.offset =
          held(joint, multiplier * of_master + offset, "follows '" + master->name + "' to ");
    } else {
      own.offset = offset;
    }
  }

  /// `position` within the joint's limits; what is cut off is said. Of a joint that follows
  /// another, limits that are one are none: exporters write 0 and 0.
  double held(const Joint& joint, double position, const std::string& how) {
    if (!joint.mimics.empty() && joint.lower == joint.upper) return position;
    if (joint.lower > joint.upper) {
      notice(joint_title(joint) + ": its lower limit is above its upper one; it stands at " +
             exact_text(position));
      return position;
    }
    const double within = std::clamp(position, joint.lower, joint.upper);
    if (std::abs(within - position) > kLimitTolerance) {
      notice(joint_title(joint) + " " + how + exact_text(position) + ", outside its limits " +
             exact_text(joint.lower) + " ... " + exact_text(joint.upper) + ": it stands at " +
             exact_text(within));
    }
    return within;
  }

  /// A joint that nothing moves.
  void stand(const Joint& joint, JointDrive& own) {
    const auto it = setup_.standing.find(joint.name);
    if (it == setup_.standing.end()) {
      own.offset = held(joint, 0.0, "is not moved here and would stand at ");
      if (before_camera_.count(joint.name) > 0) {
        notice(joint_title(joint) + " lies between '" + setup_.base_link + "' and '" +
               setup_.camera_frame + "' but is not in arm_joints: it stands at " +
               exact_text(own.offset));
      }
      return;
    }
    own.offset = it->second;
    const bool within =
        own.offset >= joint.lower - kLimitTolerance && own.offset <= joint.upper + kLimitTolerance;
    if (within || !joint.flaw.empty()) return;  // a flaw: the file gives no limits
    problem(joint_title(joint) + ": standing at " + exact_text(own.offset) +
            " is outside its limits " + exact_text(joint.lower) + " ... " +
            exact_text(joint.upper));
  }

  void place(const Joint& joint, JointDrive& own) {
    const char* const type = joint.type == JointType::kPlanar ? "planar" : "floating";
    const auto it = setup_.standing_poses.find(joint.name);
    if (it != setup_.standing_poses.end()) {
      own.pose = it->second;
      const Vec3 turned = own.pose.linear() * joint.axis;
      constexpr double kInPlane = 1e-6;
      const bool in_plane = std::abs(own.pose.translation().dot(joint.axis)) < kInPlane &&
                            (turned - joint.axis).norm() < kInPlane;
      if (joint.type == JointType::kPlanar && !in_plane)
        problem(joint_title(joint) +
                " is planar: its standing pose must lie in the plane at right "
                "angles to its axis");
    } else if (before_camera_.count(joint.name) > 0) {
      problem(joint_title(joint) + " is " + type + " and lies between '" + setup_.base_link +
              "' and '" + setup_.camera_frame +
              "': nothing here moves it; say in standing_poses "
              "where it stands");
    } else {
      notice(joint_title(joint) + " is " + type +
             ": it stands at its origin; say in standing_poses where else");
    }
  }

  void check_standing() {
    const auto check = [&](const std::string& name, const char* key, bool free) {
      const std::string title = std::string(key) + ": ";
      const auto it = index_.find(name);
      if (it == index_.end()) {
        problem(title + "no joint is called '" + name + "'");
        return;
      }
      const Joint& joint = robot_.joints[it->second];
      if (const std::string other = role(name); !other.empty()) {
        problem(title + "'" + name + "' is in " + other + ": it does not stand");
      } else if (joint.type == JointType::kFixed) {
        problem(title + "'" + name + "' is fixed: its origin says where");
      } else if (!joint.mimics.empty()) {
        problem(title + "'" + name + "' mimics '" + joint.mimics + "': say where that one stands");
      } else if (free != moves_freely(joint)) {
        problem(title + "'" + name + "' " +
                (free ? "has one position: say it in standing_joints_rad"
                      : "has a whole pose: say it in standing_poses"));
      }
    };
    for (const auto& [name, position] : setup_.standing) check(name, "standing_joints_rad", false);
    for (const auto& [name, pose] : setup_.standing_poses) check(name, "standing_poses", true);
  }

  const RobotDescription& robot_;
  const RobotSetup& setup_;
  std::map<std::string, std::size_t> index_;
  std::set<std::string> before_camera_;  // joints between base link and camera
  JointDrives found_;
};

}  // namespace

std::string joint_title(const Joint& joint) {
  return (joint.place.empty() ? "" : joint.place + ": ") + "joint '" + joint.name + "'";
}

Pose joint_pose(const Joint& joint, double position) {
  Pose T = joint.T_parent_joint;
  if (position == 0.0) return T;
  if (joint.type == JointType::kPrismatic) T.translate(joint.axis * position);
  if (joint.type == JointType::kRevolute) T.rotate(Eigen::AngleAxisd(position, joint.axis));
  return T;
}

JointDrives find_drives(const RobotDescription& robot, const RobotSetup& setup) {
  return DriveFinder(robot, setup).find();
}

}  // namespace canopeer
