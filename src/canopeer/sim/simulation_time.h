#pragma once

#include <chrono>

namespace canopeer {

/// Seconds since the simulation began: counted up by what happens, or the wall's, without pauses.
/// Used by the mission's thread; now_s() by any.
class SimulationTime {
 public:
  explicit SimulationTime(bool realtime);

  [[nodiscard]] double now_s() const;
  /// Computation was done; on the wall clock its time has passed already.
  void charge(double seconds);
  /// Comes back at that time, or at once when it is past.
  void pass_until(double time_s);

  /// Puts a simulated clock back, or forward.
  void set_simulated(double time_s) { simulated_s_ = time_s; }

  /// While it lives, a wall clock stands still. Not nested.
  class Pause {
   public:
    explicit Pause(SimulationTime& time);
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;
    ~Pause();

   private:
    SimulationTime& time_;
    std::chrono::steady_clock::time_point begin_;
  };
  [[nodiscard]] Pause pause() { return Pause(*this); }

 private:
  bool realtime_;
  double simulated_s_ = 0.0;
  std::chrono::steady_clock::time_point zero_;  ///< later by every pause
  bool paused_ = false;
  double paused_at_s_ = 0.0;
};

}  // namespace canopeer
