#pragma once

#include "canopeer/mission/segment/background.h"
#include "canopeer/mission/stage_timer.h"
#include "canopeer/record/run_record.h"

namespace canopeer {

/// Where a mission's time goes. Foreground work is paid for by the clock, waiting passes, and the
/// planner's background work goes on in both.
class Timekeeper {
 public:
  /// All outlive it.
  Timekeeper(Clock& clock, const CostTable& costs, Planner& planner, int background_workers,
             StageTimer& timer);

  [[nodiscard]] double now_s() const { return clock_.now_s(); }
  [[nodiscard]] bool simulated() const { return clock_.simulated(); }
  /// Foreground work costs mission time; the background goes on in it.
  void pay(const WorkMeter& work);
  /// Nothing to do for so long.
  void pass(double seconds);
  /// Work of another core than the mission's was done.
  void aside(const WorkMeter& work);
  /// Something else takes so long.
  void goes_on(double seconds);

  /// What has passed since the last call was spent on this.
  void book(double TimeSplit::*kind);
  /// So much has passed that nothing was spent on: somebody held the mission.
  void held(double seconds) { meters_.booked_s += seconds; }

  [[nodiscard]] Background& background() { return background_; }
  [[nodiscard]] StageTimer& timer() { return timer_; }
  /// Sums since the run began: units and simulated seconds by kind.
  [[nodiscard]] std::vector<WorkItem> work_items() const;

  /// Work done while the arm waits, and beside that.
  struct Meters {
    WorkMeter foreground;
    WorkMeter background;
    TimeSplit time{};
    double booked_s = 0.0;  ///< until when, mission time
    template <typename Archive>
    void serialize(Archive& archive) {
      archive(foreground, background, time, booked_s);
    }
  };
  [[nodiscard]] const Meters& meters() const { return meters_; }
  void set_meters(const Meters& meters) { meters_ = meters; }

 private:
  Clock& clock_;
  const CostTable& costs_;
  Meters meters_;
  StageTimer& timer_;
  Background background_;
};

}  // namespace canopeer
