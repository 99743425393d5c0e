#pragma once

#include <string>
#include <vector>

#include "canopeer/mission/events/event_hub.h"
#include "canopeer/mission/mission_cursor.h"
#include "canopeer/mission/segment/frames_on_the_way.h"
#include "canopeer/mission/segment/timekeeper.h"
#include "canopeer/mission/segment/traveller.h"

namespace canopeer {

/// Moves the arm and the trolley, and says so. While the arm moves the planner's background work
/// goes on, and frames are taken where they are wanted.
class ArmMover {
 public:
  /// All outlive it; `cursor` is told how long the arm stood and moved. `sharp`: of motions
  /// to views.
  ArmMover(const RobotModel& robot, const Ports& ports, Traveller& traveller, Timekeeper& time,
           FramesOnTheWay& frames, EventHub& events, MissionCursor& cursor,
           const std::optional<ImageMotionLimit>& sharp);

  [[nodiscard]] Configuration where() const { return ports_.arm->configuration(); }
  [[nodiscard]] TrolleyState trolley() const { return ports_.trolley->state(); }

  /// Along the waypoints, the first of which is where the arm is. It stops where it must only:
  /// corners are rounded as far as `checker` allows. `kind`: "view" or "home". Where it did not
  /// arrive it stands somewhere on its way. The error: that happens again and again.
  [[nodiscard]] Expected<MotionEnd> move(const std::string& kind,
                                         const std::vector<Configuration>& waypoints,
                                         const CollisionChecker& checker);
  /// To `home`. The error says that no way was found.
  [[nodiscard]] Expected<MotionEnd> go_home(const Configuration& home,
                                            const CollisionChecker& checker);
  /// The trolley, with the arm at rest; nothing happens when it is there. Without
  /// Trolley::Drive::arm_is_parked the arm must be home.
  [[nodiscard]] Expected<void> drive(const Trolley::Drive& drive);

 private:
  [[nodiscard]] JointPath without_needless_stops(const JointPath& stopping,
                                                 const CollisionChecker& checker);
  [[nodiscard]] Expected<void> drive_looking(const Trolley::Drive& drive, MotionEvent& motion);
  [[nodiscard]] Expected<void> mind(const MotionOutcome& outcome);

  const RobotModel& robot_;
  Ports ports_;
  Traveller& traveller_;
  Timekeeper& time_;
  FramesOnTheWay& frames_;
  EventHub& events_;
  MissionCursor& cursor_;
  std::optional<ImageMotionLimit> sharp_;
};

}  // namespace canopeer
