#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "canopeer/mission/mission_options.h"
#include "canopeer/mission/perception.h"
#include "canopeer/mission/ports.h"
#include "canopeer/mission/stage_timer.h"
#include "canopeer/record/record_file.h"
#include "canopeer/record/run_record.h"

namespace canopeer {

/// How far a mission is; for progress bars.
struct MissionProgress {
  int segment = 0;  ///< 0 …
  int segments = 1;
  double time_s = 0.0;    ///< mission time
  double fraction = 0.0;  ///< of the whole mission, 0 … 1
  int views = 0;
  int fruits = 0;
};

/// Called after every view, from the mission's thread.
using ProgressSink = std::function<void(const MissionProgress&)>;

/// The whole job: works through the segments one by one. In each it senses, maps, plans and acts
/// until the time is up
/// ([Zaenker23], Fig. 2); between them the arm goes home and the trolley drives on. The graph is
/// made anew per segment, the map is kept. Runs on whatever stands behind the ports.
class Mission {
 public:
  /// `robot`, the ports and `stop` outlive the mission. `stop` set: it ends after the motion under
  /// way.
  Mission(const RobotModel& robot, const ArmIk& ik, const ExactChecker& judge, const Ports& ports,
          const MissionOptions& options, const std::atomic<bool>& stop);
  ~Mission();

  void on_progress(ProgressSink sink);

  /// Runs all segments and writes each event to `writer` as it happens. The error is a port's (the
  /// arm refuses a motion, the camera gives no frame); what was found until then is kept and can
  /// still be read.
  [[nodiscard]] Expected<void> run(RecordWriter& writer);

  [[nodiscard]] const RunRecord& record() const;
  [[nodiscard]] const VoxelMap& map() const;
  [[nodiscard]] const FruitMap& fruits() const;
  [[nodiscard]] const StageTimer& timer() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
