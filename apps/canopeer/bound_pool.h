#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "canopeer/bounds/pipeline_ceiling.h"
#include "canopeer/bounds/view_pool.h"
#include "canopeer/run/stage.h"
#include "canopeer/sim/motion_judge.h"
#include "commands.h"

namespace canopeer::app {

/// The world that is bounded, and who judges motions in it.
struct BoundWorld {
  std::unique_ptr<Stage> stage;
  std::unique_ptr<MotionJudge> judge;
  std::uint64_t hash = 0;  ///< world_hash()

  [[nodiscard]] const Scene& scene() const { return *stage->site().truth(); }
  [[nodiscard]] const MissionFile& file() const { return stage->file(); }
};

/// What the command line says on top of the mission's file.
[[nodiscard]] Overrides bound_overrides(const BoundArguments& arguments);

/// Makes it; ends the command when something is wrong.
[[nodiscard]] BoundWorld make_bound_world(const BoundArguments& arguments);

/// The views of that world: those of the file if they are of it, else sampled, with a bar, and
/// written there. Ends the command after a stop, what was sampled kept.
[[nodiscard]] ViewPool sampled_views(const BoundArguments& arguments, const BoundWorld& world);

/// Frames of these views through the fruit map, with a bar; nothing where that is not wanted.
[[nodiscard]] std::optional<PipelineCeiling> through_the_pipeline(
    const BoundArguments& arguments, const BoundWorld& world, const ViewPool& pool,
    const std::vector<PoolViewId>& views);

}  // namespace canopeer::app
