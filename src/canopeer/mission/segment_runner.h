#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "canopeer/mission/background.h"
#include "canopeer/mission/mission.h"
#include "canopeer/mission/traveller.h"

namespace canopeer {

/// What all segments of a mission share.
struct MissionContext {
  const RobotModel& robot;
  const ArmIk& ik;
  const ExactChecker& judge;
  const Ports& ports;
  const MissionOptions& options;
  const std::atomic<bool>& stop;
  Perception& perception;
  Planner& planner;
  Background& background;
  Traveller& traveller;
  RecordWriter& writer;
  RunRecord& record;
  StageTimer& timer;
  WorkMeter& foreground;  ///< the mission's clock pays for it
  const ProgressSink& progress;
};

/// One segment: the arm stands at its home state, the trolley at its stop.
class SegmentRunner {
 public:
  SegmentRunner(MissionContext& context, int index);
  SegmentRunner(const SegmentRunner&) = delete;
  SegmentRunner& operator=(const SegmentRunner&) = delete;
  ~SegmentRunner() { context_.background.rest(); }

  /// Senses, plans and acts until the time is up; then takes the arm to `home_after`.
  [[nodiscard]] Expected<void> run(const Configuration& home_after);

 private:
  [[nodiscard]] Expected<void> observe(TargetKind kind, std::optional<std::int64_t> predicted);
  [[nodiscard]] Expected<void> take(const ViewMotion& motion);
  [[nodiscard]] Expected<void> move(const std::string& kind,
                                    const std::vector<Configuration>& waypoints);
  [[nodiscard]] JointPath without_needless_stops(const std::vector<Configuration>& waypoints);
  [[nodiscard]] Expected<void> go_home(const Configuration& home);
  [[nodiscard]] Expected<void> recover();
  [[nodiscard]] std::shared_ptr<const MapSnapshot> snapshot() const;
  Decision decide();
  void pay(const WorkMeter& work);
  void pass(double seconds);
  void report_progress() const;

  MissionContext& context_;
  int index_;
  SegmentFrame frame_;
  CollisionChecker checker_;
  SelfFilter self_filter_;
  double start_s_ = 0.0;
  double standing_since_s_ = 0.0;
  double last_standing_s_ = 0.0;  ///< before the last motion
  double last_motion_s_ = 0.0;
};

}  // namespace canopeer
