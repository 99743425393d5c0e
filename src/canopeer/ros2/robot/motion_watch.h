#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "canopeer/ros2/robot/robot_history.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer::ros {

/// Looks at what the arm really did, from standstill to standstill, and judges it on the true
/// geometry, beside everything else.
class MotionWatch {
 public:
  struct Counts {
    int motions = 0;
    int collisions = 0;      ///< with the robot itself or the structure
    int plant_contacts = 0;  ///< with plants
  };
  /// `judge` outlives the watch.
  explicit MotionWatch(const MotionJudge& judge);
  ~MotionWatch();

  /// Where the arm is now; called by one thread, at the rate of its control.
  void see(const SimulatedPlace& place, bool standing);
  /// Of all motions that ended; waits until they are judged.
  [[nodiscard]] Counts counts();

 private:
  struct Motion {
    std::vector<Configuration> states;
    TrolleyState trolley;
  };
  void work(std::stop_token stop);

  const MotionJudge& judge_;
  std::vector<Configuration> under_way_;  ///< of the thread that sees
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Motion> to_judge_;
  bool judging_ = false;
  Counts counts_;
  std::jthread worker_;
};

}  // namespace canopeer::ros
