#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/mission/ports.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer {

/// How good the simulated camera and arm are.
struct SimulationOptions {
  CameraIntrinsics camera =
      CameraIntrinsics::from_fov(640, 480, 80.0 / 180.0 * 3.14159265358979323846);
  /// Lens and faults of the camera; its intrinsics and seed are taken from here, not from there.
  RgbdSensorOptions sensor;
  /// Standard deviation of where each joint stops beside its goal, rad; the arm knows where it
  /// stopped.
  double arrival_error_rad = 0.0;
  std::uint64_t seed = 1;
  /// The clock is the wall's: motions take as long as they take. The time the simulator itself
  /// needs to render a frame and to judge a motion, which no real robot would, is left out.
  bool realtime = false;
};

/// A robot in a scene, in one process. In simulated time each port moves one clock: a run is a
/// sequence of events, as fast as the machine computes them, and the same on any machine. On the
/// wall clock nothing of that holds.
class Simulation {
 public:
  /// The arm starts in `q`. `robot` and `scene` outlive the simulation.
  Simulation(const RobotModel& robot, const Scene& scene, const Configuration& q,
             const TrolleyState& trolley, const SimulationOptions& options);
  ~Simulation();

  [[nodiscard]] Ports ports();
  /// The map whose occupied voxels a motion must not touch; null: not judged. Outlives its use.
  void watch_map(const VoxelMap* map);
  [[nodiscard]] const MotionJudge& judge() const;

  /// Where everything is between two motions, in simulated time: clock, arm, trolley, and what
  /// chance has drawn so far. As bytes.
  [[nodiscard]] std::string state() const;
  /// In a simulation with the same robot, scene and options; it is as it was after an error.
  [[nodiscard]] Expected<void> restore(std::string_view state);

 private:
  struct State;
  class SimClock;
  class SimArm;
  class SimTrolley;
  class SimCamera;
  std::unique_ptr<State> state_;
  std::unique_ptr<SimClock> clock_;
  std::unique_ptr<SimArm> arm_;
  std::unique_ptr<SimTrolley> trolley_;
  std::unique_ptr<SimCamera> camera_;
};

}  // namespace canopeer
