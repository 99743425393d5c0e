#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "canopeer/config/mission_file.h"
#include "canopeer/dds/parameters.h"
#include "canopeer/ros2/out/frame_teller.h"
#include "canopeer/ros2/out/motion_consent.h"
#include "canopeer/ros2/out/ros2_watcher.h"
#include "canopeer/ros2/out/steering_services.h"

namespace canopeer::ros {

/// All that a mission tells others on ROS 2 and takes from them besides what its ports do: topics,
/// frames, services, parameters (docs/formats.md). Thread-safe.
class Ros2Output {
 public:
  struct Parts {
    std::shared_ptr<Node> node;
    std::shared_ptr<const RosClock> clock;
    const MissionFile& file;
    const Ros2Settings& settings;
    const RobotModel& robot;
    /// Where the robot is now; nothing when nobody knows. Thread-safe.
    std::function<std::optional<RobotPlace>()> where;
  };
  /// File, robot and what `where` uses outlive it. The error: a name that ROS refuses, or the
  /// robot's URDF cannot be read.
  [[nodiscard]] static Expected<std::unique_ptr<Ros2Output>> make(const Parts& parts);
  ~Ros2Output();

  /// Where `ros2.output.enabled` is false it speaks on /rosout only.
  [[nodiscard]] std::shared_ptr<Watcher> watcher() const { return watcher_; }
  [[nodiscard]] Steering& steering() { return *services_; }
  /// The run's directory: `~/save` writes into `saved` in it.
  void save_into(const std::filesystem::path& out);

  // What the ports ask and tell (PersonHooks).
  [[nodiscard]] bool stop_asked() const { return services_->stop_asked(); }
  /// Whether a motion may be; asks a person when every motion is to be asked for.
  /// `given_up`: nobody waits for the answer any more.
  [[nodiscard]] bool may_move(const std::string& motion, const std::function<bool()>& given_up) {
    return consent_.may(motion, given_up);
  }
  /// A warning on /rosout.
  void tell(const std::string& text) const;

 private:
  Ros2Output(const Parts& parts, const Ros2Settings& settings);
  [[nodiscard]] Expected<void> open(const Parts& parts);
  [[nodiscard]] Expected<void> open_parameters(const Parts& parts);
  [[nodiscard]] Expected<void> open_frames(const Parts& parts);
  [[nodiscard]] Expected<std::string> save() const;
  void set_rate(double Ros2OutputSettings::*which, double rate_hz);

  std::shared_ptr<Node> node_;
  std::shared_ptr<const RosClock> clock_;
  mutable std::mutex mutex_;
  Ros2OutputSettings settings_;
  std::filesystem::path out_;
  std::shared_ptr<Ros2Watcher> watcher_;
  MotionConsent consent_;
  std::unique_ptr<SteeringServices> services_;
  std::unique_ptr<FrameTeller> frames_;
  std::unique_ptr<Parameters> parameters_;
};

}  // namespace canopeer::ros
