#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/mission/ports.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/arm/motion_ending.h"
#include "canopeer/ros2/arm/person_hooks.h"
#include "canopeer/ros2/arm/safety_mode.h"
#include "canopeer/ros2/time/joint_history.h"
#include "canopeer/ros2/time/ros_clock.h"

namespace canopeer::ros {

/// An arm behind a FollowJointTrajectory action. Nothing moves without fresh joint states, nor from
/// elsewhere than where the arm is.
class Ros2Arm : public Arm {
 public:
  struct Parts {
    Node& node;
    const RobotModel& robot;     ///< with the limits that motions are to keep
    const JointHistory& joints;  ///< of the arm's joints, in their order
    RosClock& clock;
    PersonHooks person;
    /// Who contradict each other about joints, for people (JointListener); empty: nobody.
    std::function<std::optional<std::string>()> contradiction{};
  };
  /// `settings` holds what the arm needs to know. All parts outlive it. The error: the action or a
  /// topic cannot be had.
  [[nodiscard]] static Expected<std::unique_ptr<Ros2Arm>> make(Parts parts,
                                                               const Ros2Settings& settings);

  /// The controller is there.
  [[nodiscard]] bool ready() const { return client_->ready(); }

  /// The error: where the arm is is not known any more, since joint states or the time stay out, or
  /// publishers contradict each other.
  [[nodiscard]] Expected<void> fresh() const;

  /// A motion that was started and has no end, as far as is known, is told to stop.
  void end_motion() { client_->stop(); }

  /// As the last joint states say. Those that are beyond a limit by no more than the tolerance of
  /// starts are at the limit. Zeros before the first joint states.
  [[nodiscard]] Configuration configuration() const override;
  [[nodiscard]] Expected<double> start(const JointPath& path) override;
  [[nodiscard]] Expected<MotionOutcome> finish() override;

 private:
  Ros2Arm(Parts parts, const Ros2Settings& settings, std::unique_ptr<TrajectoryClient> client,
          std::unique_ptr<SafetyMode> safety);

  [[nodiscard]] Configuration drivers_positions() const;
  [[nodiscard]] Expected<bool> may_begin(const JointPath& path);
  [[nodiscard]] std::optional<MotionOutcome> refusal(const JointPath& path) const;
  [[nodiscard]] JointLimits limits() const;
  [[nodiscard]] std::optional<std::string> cancel_reason() const;
  [[nodiscard]] Expected<MotionOutcome> finish_sent();
  void wait_out(double duration_s) const;
  void wait_for_standstill() const;
  void find_farthest(MotionReport& report) const;
  double hold_back(MotionEnd end, std::string why, double duration_s = 0.0);

  Parts parts_;
  const Ros2ArmSettings settings_;
  const bool dry_run_;
  std::unique_ptr<TrajectoryClient> client_;
  std::unique_ptr<SafetyMode> safety_;  ///< null: the driver does not say it
  std::vector<std::string> names_;      ///< the driver's
  int motions_ = 0;                     ///< that were sent
  // Of the motion started last:
  std::optional<MotionOutcome> held_back_;  ///< it was not sent
  FollowJointTrajectory::Goal goal_;
  double duration_s_ = 0.0;
};

}  // namespace canopeer::ros
