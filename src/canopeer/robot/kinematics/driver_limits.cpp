#include <cmath>
#include <limits>

#include "canopeer/base/exact_text.h"
#include "canopeer/robot/kinematics/joint_drives.h"

namespace canopeer {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr double kSurelyDegrees = 20.0;  // rad; no arm turns three times round and then stops

bool has_range(const Joint& joint) {
  return std::isfinite(joint.lower) || std::isfinite(joint.upper);
}

/// The limits of a joint that moves by itself.
class DriverLimits {
 public:
  DriverLimits(Joint& joint, bool in_arm, JointDrives& drives)
      : joint_(joint), in_arm_(in_arm), drives_(drives) {}

  void check() {
    if (!joint_.flaw.empty()) {
      drives_.problems.push_back(joint_title(joint_) + " cannot be moved: " + joint_.flaw);
      return;
    }
    if (in_arm_ && joint_.type == JointType::kRevolute) drop_far_limits();
    const bool endless = in_arm_ && joint_.type == JointType::kRevolute &&
                         joint_.lower == -kNoLimit && joint_.upper == kNoLimit;
    const auto number = [](double value) { return std::isfinite(value); };
    std::string missing;
    const auto want = [&](bool there, const char* what) {
      if (!there) missing += std::string(missing.empty() ? "" : ", ") + what;
    };
    want(endless || (number(joint_.lower) && number(joint_.upper)), "lower and upper");
    want(number(joint_.velocity_limit) && joint_.velocity_limit > 0.0,
         in_arm_ ? "velocity above 0 (or arm_velocity_limits_rad_s in the robot file)"
                 : "velocity above 0");
    want(number(joint_.acceleration_limit) && joint_.acceleration_limit > 0.0,
         "acceleration above 0");
    if (!missing.empty()) {
      drives_.problems.push_back(joint_title(joint_) + " needs finite limits; missing: " + missing);
    } else if (!endless) {
      check_range();
    }
  }

  /// As far as `follower` stays within its own limits; joints that follow may have none.
  void narrow(const Joint& follower, const JointDrive& drive) {
    if (follower.velocity_limit > 0.0)
      joint_.velocity_limit =
          std::min(joint_.velocity_limit, follower.velocity_limit / std::abs(drive.multiplier));
    if (!has_range(follower) || follower.lower >= follower.upper) {
      check_turns(follower, drive);
      return;
    }
    double low = (follower.lower - drive.offset) / drive.multiplier;
    double high = (follower.upper - drive.offset) / drive.multiplier;
    if (low > high) std::swap(low, high);
    if (low <= joint_.lower + kLimitTolerance && high >= joint_.upper - kLimitTolerance) return;
    joint_.lower = std::max(joint_.lower, low);
    joint_.upper = std::min(joint_.upper, high);
    if (joint_.lower > joint_.upper) {
      drives_.problems.push_back(joint_title(joint_) + ": '" + follower.name +
                                 "' follows it and stays within its own limits nowhere");
      return;
    }
    drives_.notices.push_back(joint_title(joint_) + " moves from " + exact_text(joint_.lower) +
                              " to " + exact_text(joint_.upper) + " only: beyond that '" +
                              follower.name + "', which follows it, is outside its limits");
  }

 private:
  /// Some write 1e16 where they mean none.
  void drop_far_limits() {
    if (!(joint_.lower < -kLargestPosition && joint_.upper > kLargestPosition)) return;
    if (std::isfinite(joint_.lower) || std::isfinite(joint_.upper))
      drives_.notices.push_back(joint_title(joint_) + ": its limits " + exact_text(joint_.lower) +
                                " ... " + exact_text(joint_.upper) +
                                " are none: it turns without end");
    joint_.lower = -kNoLimit;
    joint_.upper = kNoLimit;
  }

  void check_range() {
    if (joint_.lower > joint_.upper || joint_.lower < -kLargestPosition ||
        joint_.upper > kLargestPosition) {
      drives_.problems.push_back(joint_title(joint_) +
                                 ": expected lower <= upper, both within 1e4, found " +
                                 exact_text(joint_.lower) + " and " + exact_text(joint_.upper));
      return;
    }
    if (!in_arm_) return;
    if (joint_.soft_lower > joint_.lower || joint_.soft_upper < joint_.upper)
      drives_.notices.push_back(
          joint_title(joint_) + ": the soft limits of its <safety_controller>, " +
          exact_text(joint_.soft_lower) + " ... " + exact_text(joint_.soft_upper) +
          ", are not used; if its controller keeps to them, write them into <limit>");
    if (joint_.lower == joint_.upper)
      drives_.notices.push_back(joint_title(joint_) + " cannot move: both its limits are " +
                                exact_text(joint_.lower));
    if (joint_.type == JointType::kRevolute &&
        (joint_.lower < -kSurelyDegrees || joint_.upper > kSurelyDegrees))
      drives_.notices.push_back(joint_title(joint_) + ": its limits " + exact_text(joint_.lower) +
                                " ... " + exact_text(joint_.upper) +
                                " rad are more than three turns; are they degrees?");
  }

  /// A turn of an endless joint must be a turn of what follows it.
  void check_turns(const Joint& follower, const JointDrive& drive) {
    if (joint_.lower != -kNoLimit || joint_.upper != kNoLimit) return;
    if (follower.type == JointType::kRevolute && std::round(drive.multiplier) == drive.multiplier)
      return;
    drives_.problems.push_back(joint_title(joint_) + " turns without end, but '" + follower.name +
                               "' follows it by " + exact_text(drive.multiplier) +
                               ": one of them needs limits");
  }

  Joint& joint_;
  bool in_arm_;
  JointDrives& drives_;
};

}  // namespace

void limit_drivers(RobotDescription& robot, JointDrives& drives) {
  using Kind = JointDrive::Kind;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const JointDrive& own = drives.of[i];
    if (own.kind == Kind::kStands || own.follows) continue;
    Joint& joint = robot.joints[i];
    DriverLimits limits(joint, own.kind == Kind::kArm, drives);
    limits.check();
    for (std::size_t k = 0; k < robot.joints.size(); ++k) {
      const JointDrive& other = drives.of[k];
      if (other.follows && other.kind == own.kind && other.arm_joint == own.arm_joint)
        limits.narrow(robot.joints[k], other);
    }
  }
}

}  // namespace canopeer
