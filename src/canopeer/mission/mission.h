#pragma once

#include <memory>
#include <vector>

#include "canopeer/mission/events/event_hub.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/mission/mission_state.h"
#include "canopeer/mission/ports.h"
#include "canopeer/mission/registries.h"
#include "canopeer/mission/robot_kit.h"
#include "canopeer/mission/stage_timer.h"

namespace canopeer {

/// The whole job: works through the segments one by one. In each it senses, maps, plans and acts
/// until the time is up ([Zaenker23], Fig. 2). Between them the arm goes home and the trolley
/// drives on. The graph is made anew for each segment, the map is kept. Runs on whatever stands
/// behind the ports. Used from one thread.
class Mission {
 public:
  /// What `robot` and `ports` point to outlives the mission.
  Mission(const RobotKit& robot, const Ports& ports, const MissionOptions& options,
          const Registries& registries);
  ~Mission();

  /// Who listens and who steers: said before the first step. What is referred to outlives the
  /// mission.
  void keep(Keeper& keeper);
  void watch(std::shared_ptr<Watcher> watcher, const WatchOptions& options = {});
  void steer(Steering& steering);

  /// All steps, and end(). The error is that of a port (the arm refuses a motion, the camera gives
  /// no frame), of the detector or of a keeper, or an exception of theirs. What was found until
  /// then can be read.
  [[nodiscard]] Expected<void> run();

  /// One step; false: it was the last one. For those who stop in between: end() comes when they
  /// have had enough. After an error only end() may come.
  [[nodiscard]] Expected<bool> step();
  /// Once: shapes are fitted anew, the last events are said.
  [[nodiscard]] Expected<void> end();

  /// Between two steps. The error: time is not simulated, the mission has failed, or its planner
  /// cannot write its state.
  [[nodiscard]] Expected<MissionState> state() const;
  /// Whether a state can be one of this mission; restore() asks too.
  [[nodiscard]] Expected<void> check(const MissionState& state) const;
  /// In place of the first step: goes on from there. What stands behind the ports must be as it
  /// was. After an error only end() may come.
  [[nodiscard]] Expected<void> restore(MissionState state);

  [[nodiscard]] const MissionCursor& cursor() const;
  [[nodiscard]] const VoxelMap& map() const;
  [[nodiscard]] const FruitMap& fruits() const;
  [[nodiscard]] const StageTimer& timer() const;
  /// What became of the watchers, after the end.
  [[nodiscard]] std::vector<EventHub::Watched> watched() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
