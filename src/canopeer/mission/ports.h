#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/robot/joint_path.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/sensing/camera_twist.h"
#include "canopeer/sensing/rgbd_frame.h"

// What a mission needs of the world, simulated or real. C++17-clean: robot adapters include this.

namespace canopeer {

/// Mission time. One for all ports of a run.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since the mission began.
  [[nodiscard]] virtual double now_s() const = 0;
  /// Computation worth so many seconds was done: a simulated clock moves on by it, a wall clock has
  /// moved already.
  virtual void charge(double compute_s) = 0;
  /// Lets so many seconds pass.
  virtual void sleep(double seconds) = 0;
  /// It moves on by these calls and by motions only, so that one may wait as long as one likes.
  [[nodiscard]] virtual bool simulated() const { return false; }
};

/// Why a motion of the arm ended.
enum class MotionEnd {
  arrived,
  refused,    ///< the controller did not begin it
  aborted,    ///< by the controller: a tolerance was missed, a limit reached
  cancelled,  ///< by whoever may: a person, a watchdog of ours
  preempted,  ///< somebody else moves the arm
  stopped,    ///< a protective or emergency stop: a person has to look
  withheld    ///< a dry run: nothing was to move
};
/// "arrived", "refused", …
[[nodiscard]] std::string_view motion_end_name(MotionEnd end);

/// How a motion of the arm ended.
struct MotionOutcome {
  Configuration q;  ///< where the arm is now, rad
  MotionEnd end = MotionEnd::arrived;
  std::string why;         ///< for people, when it did not arrive
  bool collision = false;  ///< with itself, the structure or what was mapped at the start (false
                           ///< where nobody can know)
  bool plant_contact = false;  ///< with a part of a plant that was not mapped
};

/// The arm, as a mission moves it. One call at a time.
class Arm {
 public:
  virtual ~Arm() = default;
  /// Joint positions now, rad. Of joints that turn without end (RobotModel::endless) those modulo
  /// whole turns are as good.
  [[nodiscard]] virtual Configuration configuration() const = 0;
  /// Starts a motion along a path that begins where the arm is, and stands still only where the
  /// path says so. This path, arcs included, is what was checked for collisions, so no other will
  /// do (PathMotion times it and gives trajectory points at any rate). Joints that turn without end
  /// run on from its first values beyond ±π: how far and which way they turn. Returns how long it
  /// will take, s. The error ends the run; a motion that was refused may be an outcome instead.
  [[nodiscard]] virtual Expected<double> start(const JointPath& path) = 0;
  /// Waits for the end of the motion started last; the arm stands still then. The error ends the
  /// run: whoever moves the arm is gone, or where it is cannot be known.
  [[nodiscard]] virtual Expected<MotionOutcome> finish() = 0;
};

/// What carries the arm along the row and lifts it.
class Trolley {
 public:
  virtual ~Trolley() = default;
  [[nodiscard]] virtual TrolleyState state() const = 0;
  /// Drives there and waits; the arm must be home.
  [[nodiscard]] virtual Expected<void> move_to(const TrolleyState& goal) = 0;

  /// The same in two calls, for those who look around on the way: sets out and returns how long it
  /// will take, s; 0: not known. The error: it cannot drive that slowly, or the goal is out of
  /// reach.
  struct Drive {
    TrolleyState goal;
    double max_travel_m_s = 0.0;  ///< along the row; 0: as fast as it can
    bool arm_is_parked = false;   ///< not at home, to look at the row while it drives
  };
  [[nodiscard]] virtual Expected<double> set_out(const Drive& drive) {
    if (drive.max_travel_m_s > 0.0) return fail("this trolley cannot be told how fast to drive");
    if (drive.arm_is_parked) return fail("this trolley drives with the arm at home only");
    goal_ = drive.goal;
    return 0.0;
  }
  /// Waits for the end of the drive started last.
  [[nodiscard]] virtual Expected<void> arrive() { return move_to(goal_); }
  /// state() is right while it drives, too. False: a person pushes it, say; frames from then have
  /// no place.
  [[nodiscard]] virtual bool knows_where_it_drives() const { return true; }

 private:
  TrolleyState goal_;
};

/// A frame taken whether things moved or not, before anybody has looked at its images.
struct StreamedFrame {
  double time_s = 0.0;     ///< mission time in the middle of the exposure, by its stamp
  double arrived_s = 0.0;  ///< mission time
  CameraIntrinsics intrinsics;
  Pose T_world_camera = Pose::Identity();  ///< then, as the robot says
  CameraTwist twist;                       ///< then
  Configuration q;                         ///< arm then, rad
  TrolleyState trolley;                    ///< then
  /// Its images, with this time and pose: decoded, or rendered, at this call. Once.
  std::function<Expected<RgbdFrame>()> images;
};

/// The camera at the arm's flange.
class Camera {
 public:
  virtual ~Camera() = default;
  /// One frame from where the camera is now, with pose and time. The arm stands still.
  [[nodiscard]] virtual Expected<RgbdFrame> capture() = 0;

  /// From now on frames are kept for arrived(), at most so many a second; 0: no more. The error:
  /// this camera gives frames at rest only.
  [[nodiscard]] virtual Expected<void> stream(double hz) {
    if (hz > 0.0) return fail("this camera gives no frames while it moves");
    return {};
  }
  /// The frames that have arrived since the last call, by time; the oldest may be lost where nobody
  /// asks for long. May be called in another thread than the arm's and the trolley's methods.
  [[nodiscard]] virtual Expected<std::vector<StreamedFrame>> arrived() {
    return std::vector<StreamedFrame>();
  }
};

/// The four together; the pointed-to objects outlive the mission.
struct Ports {
  Clock* clock = nullptr;
  Arm* arm = nullptr;
  Trolley* trolley = nullptr;
  Camera* camera = nullptr;
};

}  // namespace canopeer
