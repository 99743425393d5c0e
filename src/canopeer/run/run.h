#pragma once

#include <filesystem>
#include <memory>

#include "canopeer/mission/mission.h"
#include "canopeer/record/summary.h"
#include "canopeer/record/yardstick.h"
#include "canopeer/run/run_state.h"
#include "canopeer/run/stage.h"

namespace canopeer {

/// A run from beginning to end: a stage, the mission on it, who keeps and who watches, and the
/// results in a directory. The one place where these come together; the program, tests and
/// benchmarks all run missions this way.
class Run {
 public:
  /// `out`: where results go; empty: `out/MISSION-PLANNER-seedN`. The error is about the mission's
  /// files or settings, or `out` cannot be made.
  [[nodiscard]] static Expected<std::unique_ptr<Run>> compose(const StageRequest& request,
                                                              const RunRegistries& registries,
                                                              std::filesystem::path out);
  /// The same from settings made by hand.
  [[nodiscard]] static Expected<std::unique_ptr<Run>> compose(MissionFile file,
                                                              const StageRequest& request,
                                                              const RunRegistries& registries,
                                                              std::filesystem::path out);
  ~Run();

  /// Who watches, who keeps, who steers, besides those of the site: said before begin(). Keepers
  /// and steering outlive the run.
  void watch(std::shared_ptr<Watcher> watcher, const WatchOptions& options = {});
  void keep(Keeper& keeper);
  void steer(Steering& steering);
  /// Results are given as shares of this too. Before finish(). The error: it is of another mission,
  /// protocol or world.
  [[nodiscard]] Expected<void> hold_against(Yardstick yardstick);

  /// begin(), every step, finish(). The error is what ended the run early, or about writing;
  /// results so far are written all the same.
  [[nodiscard]] Expected<Summary> execute();

  /// Starts the record.
  [[nodiscard]] Expected<void> begin();
  /// In place of begin(): goes on from `state`, with the record that lies in the directory. The
  /// error: the state or the record is of another run, or the site cannot be put back. The record
  /// is then as it was, and the run cannot be used.
  [[nodiscard]] Expected<void> resume(RunState state);
  /// One step of the mission; false: it was the last one, or a failure ended the run: outcome().
  [[nodiscard]] bool step();
  /// Once: scores the run and writes its results. The error is about writing.
  [[nodiscard]] Expected<Summary> finish();

  /// Between two steps, in simulated time.
  [[nodiscard]] Expected<RunState> state() const;

  /// What ended the run early.
  [[nodiscard]] const Expected<void>& outcome() const;
  /// It ended, or was ended, before its last segment did.
  [[nodiscard]] bool interrupted() const;
  [[nodiscard]] const std::filesystem::path& out() const;
  [[nodiscard]] const MissionFile& file() const;
  [[nodiscard]] Stage& stage();
  [[nodiscard]] const Mission& mission() const;
  /// After begin().
  [[nodiscard]] const RunRecord& record() const;

 private:
  struct State;
  explicit Run(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace canopeer
