#include <oneapi/tbb/global_control.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "bound_plans.h"
#include "bound_pool.h"
#include "bound_record.h"
#include "bound_table.h"
#include "canopeer/bounds/world_hash.h"
#include "commands.h"
#include "exit_status.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) stop_with(kFailed, {folder.string() + ": cannot be made: " + code.message()});
}

Yardstick unknown_yet(const BoundWorld& world) {
  const MissionOptions& mission = world.file().mission;
  Yardstick y;
  y.mission = mission.name;
  y.protocol = mission.protocol.empty() ? "own" : mission.protocol;
  y.world_seed = mission.seed;
  y.world_hash = hash_text(world.hash);
  y.fruits_total = world.scene().counted_fruits();
  return y;
}

/// What the world is, and what can be seen in it at all.
BoundResults start_with_ceiling(const BoundArguments& arguments, const BoundWorld& world,
                                const ViewPool& pool) {
  BoundResults results;
  results.yardstick = unknown_yet(world);
  results.rule.min_area_cm2 = arguments.min_area_cm2.value_or(results.rule.min_area_cm2);
  results.ceiling = ceiling_of(pool, results.rule);
  results.cover = cover_of(pool, results.rule);
  Yardstick& y = results.yardstick;
  y.ceiling_fruits = results.ceiling.fruits;
  y.ceiling_surface = results.ceiling.surface;
  y.ceiling_views = results.ceiling.views;
  y.ceiling_seen_once = results.ceiling.seen_once;
  y.cover_views_90 = results.cover.views_90;
  y.cover_views_100 = static_cast<int>(results.cover.views.size());
  return results;
}

/// Plans go by the area with which a fruit is as often found as not: as measured in this world, or
/// as decision 111 has it.
FindRule plan_rule(const BoundArguments& arguments, const BoundResults& results) {
  constexpr double kEvenCm2 = 16.0;
  const bool measured = results.pipeline && results.pipeline->find.even_cm2 > 0.0;
  const double even_cm2 = measured ? results.pipeline->find.even_cm2 : kEvenCm2;
  return {arguments.min_area_cm2.value_or(even_cm2)};
}

}  // namespace

/// Each step leaves what it earned in the directory.
void bound(const BoundArguments& arguments) {
  std::unique_ptr<tbb::global_control> threads;
  if (arguments.threads > 0) {
    threads = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(arguments.threads));
  }
  const fs::path out = arguments.out;
  const BoundWorld world = make_bound_world(arguments);
  if (!arguments.record.empty()) expect_same_world(arguments.record, unknown_yet(world));
  make_folder(out);
  const ViewPool pool = sampled_views(arguments, world);
  BoundResults results = start_with_ceiling(arguments, world, pool);
  results.pipeline = through_the_pipeline(arguments, world, pool, results.cover.views);
  results.plan_rule = plan_rule(arguments, results);
  if (arguments.plans) add_clairvoyant(arguments, world, pool, results);
  add_upper_bounds(world, pool, results);
  value_or_stop(write_yardstick(out / "yardstick.json", results.yardstick), kFailed);
  if (!arguments.quiet) print_bounds(results);
  if (!check_bounds(results.yardstick)) throw Stop{kFailed};
  if (!arguments.record.empty()) keep_record(arguments.record, out, results.yardstick);
}

}  // namespace canopeer::app
