#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "canopeer/planner/planner.h"
#include "canopeer/planner/playback/plan_file.h"

namespace canopeer {

/// Which plan is followed.
struct PlaybackOptions {
  std::filesystem::path plan;  ///< plan_file.h
  /// What it has to fit, where the mission and the robot are known; nothing: it is held against
  /// neither.
  std::optional<PlanFit> fit{};
};

/// Takes the views of a plan, one after the other, by straight motions in joint space: how the best
/// plans known are executed again. It looks at no map and asks nobody whether the way is free; that
/// is up to whoever made the plan. A segment whose views are all taken is done.
///
/// Where the arm did not arrive, it goes on with the next view from where it is.
class PlaybackPlanner : public Planner {
 public:
  explicit PlaybackPlanner(ViewPlan plan);

  void begin_segment(const PlanningScene& scene) override;
  Decision decide(const Configuration& q, WorkMeter& work) override;
  [[nodiscard]] Expected<std::string> state() const override;
  /// The error is also that the plan is another one than the state was written with.
  [[nodiscard]] Expected<void> restore(const PlanningScene& scene, std::string_view state) override;

 private:
  [[nodiscard]] std::span<const Configuration> views() const;

  ViewPlan plan_;
  std::uint64_t plan_hash_ = 0;
  PlanningScene scene_;
  std::uint64_t next_ = 0;  ///< of the segment's views
};

/// Reads the plan. The error names the file, and where in it what is wrong.
[[nodiscard]] Expected<std::unique_ptr<Planner>> make_playback(const PlaybackOptions& options);

}  // namespace canopeer
