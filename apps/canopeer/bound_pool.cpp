#include "bound_pool.h"

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/bounds/view_pool_builder.h"
#include "canopeer/bounds/view_pool_file.h"
#include "canopeer/bounds/world_hash.h"
#include "canopeer/config/robot_file.h"
#include "exit_status.h"
#include "import_line.h"
#include "mission_arguments.h"
#include "progress_bar.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void interrupted(const BoundArguments& arguments) {
  std::fprintf(stderr, "canopeer: interrupted; the same command goes on from what is in %s\n",
               arguments.out.c_str());
  throw Stop{kInterrupted};
}

std::vector<std::string> robot_texts(const fs::path& robot) {
  std::vector<std::string> texts{value_or_stop(read_file(robot), kBadInput)};
  const fs::path urdf = value_or_stop(robot_urdf(robot), kBadInput);
  texts.push_back(value_or_stop(read_file(urdf), kBadInput));
  return texts;
}

PoolOptions pool_options(const BoundArguments& arguments, const BoundWorld& world) {
  PoolOptions options;
  options.world = world.hash;
  options.aimed = arguments.views_per_fruit.value_or(options.aimed);
  options.most = arguments.most_views.value_or(options.most);
  options.batch = std::min(options.batch, options.most);
  options.checkpoint = fs::path(arguments.out) / "views.part";
  return options;
}

/// How far sampling is, for people.
class PoolBar {
 public:
  explicit PoolBar(bool quiet) : bar_(quiet) {}

  void show(const PoolProgress& p) {
    char text[160];
    const double once = p.course.patches > 0 ? 100.0 * p.course.seen_once / p.course.patches : 0.0;
    const std::string where = p.again > 0 ? "all segments again, round " + std::to_string(p.again)
                                          : "views of segment " + std::to_string(p.segment + 1) +
                                                "/" + std::to_string(p.segments);
    std::snprintf(text, sizeof text, "%s  %6lld sampled  %3d fruits  %4.1f %% of patches seen once",
                  where.c_str(), static_cast<long long>(p.course.sampled), p.course.fruits, once);
    bar_.show(p.share, text, p.segment + p.again);
  }
  void finish() { bar_.finish(); }

 private:
  ProgressBar bar_;
};

ViewPool sample(const BoundArguments& arguments, const BoundWorld& world,
                const PoolOptions& options) {
  PoolBar bar(arguments.quiet);
  const auto& stop = catch_stop_signals();
  PoolCallbacks callbacks;
  callbacks.progress = [&](const PoolProgress& progress) { bar.show(progress); };
  callbacks.stop = [&] { return stop.load(); };
  const RobotKit robot = world.stage->robot();
  const auto begin = std::chrono::steady_clock::now();
  auto pool =
      build_view_pool(robot.model, robot.ik, world.scene(), *world.judge, world.file().mission,
                      world.file().simulation.camera, options, callbacks);
  bar.finish();
  if (!pool && stop) interrupted(arguments);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ViewPool views = value_or_stop(std::move(pool), kFailed);
  if (!arguments.quiet) {
    std::fprintf(stderr, "canopeer: looked from %lld configurations in %.1f s, %.0f a second\n",
                 static_cast<long long>(views.sampled), took.count(),
                 static_cast<double>(views.sampled) / took.count());
  }
  return views;
}

}  // namespace

Overrides bound_overrides(const BoundArguments& arguments) {
  Overrides overrides;
  if (!arguments.protocol.empty()) overrides.emplace_back("protocol", arguments.protocol);
  if (arguments.segments) {
    overrides.emplace_back("max_segments", std::to_string(*arguments.segments));
  }
  return overrides;
}

BoundWorld make_bound_world(const BoundArguments& arguments) {
  BoundWorld world;
  ImportLine line(arguments.quiet);
  const Overrides overrides = bound_overrides(arguments);
  StageRequest request = stage_request(arguments.mission, overrides);
  request.callbacks = callbacks_for_people(line, arguments.quiet);
  world.stage = value_or_stop(
      Stage::make(load(arguments.mission, overrides), request, *arguments.mission.registries),
      kBadInput);
  constexpr double kStepM = 0.01;
  constexpr int kStops = 16;  // plans go to and fro between them
  world.judge =
      std::make_unique<MotionJudge>(world.stage->robot().model, world.scene(), kStepM, kStops);
  world.hash =
      world_hash(world.scene(), robot_texts(world.file().robot), world.file().simulation.camera);
  return world;
}

ViewPool sampled_views(const BoundArguments& arguments, const BoundWorld& world) {
  const PoolOptions options = pool_options(arguments, world);
  const fs::path path =
      arguments.pool.empty() ? fs::path(arguments.out) / "views.pool" : fs::path(arguments.pool);
  if (fs::exists(path)) {
    auto pool = read_view_pool(path);
    const bool fits = pool && pool->key == pool_key(world.file().mission,
                                                    world.file().simulation.camera, options);
    if (fits) return std::move(*pool);
    const std::string why =
        pool ? "is of another world or of other settings" : pool.error().message;
    std::fprintf(stderr, "canopeer: notice: %s: %s; views are sampled anew\n", path.c_str(),
                 why.c_str());
  }
  ViewPool pool = sample(arguments, world, options);
  value_or_stop(write_view_pool(path, pool), kFailed);
  return pool;
}

std::optional<PipelineCeiling> through_the_pipeline(const BoundArguments& arguments,
                                                    const BoundWorld& world, const ViewPool& pool,
                                                    const std::vector<PoolViewId>& views) {
  if (!arguments.pipeline) return std::nullopt;
  ProgressBar bar(arguments.quiet);
  const auto& stop = catch_stop_signals();
  PipelineCallbacks callbacks;
  callbacks.stopped = [&] { return stop.load(); };
  callbacks.progress = [&](int done, int all) {
    bar.show(static_cast<double>(done) / all,
             "frame " + std::to_string(done) + "/" + std::to_string(all) + " of the set cover", 0);
  };
  auto result =
      pipeline_ceiling(world.scene(), world.file().mission, arguments.mission.registries->detectors,
                       world.file().simulation, pool, views, callbacks);
  bar.finish();
  if (!result && stop) interrupted(arguments);
  return value_or_stop(std::move(result), kFailed);
}

}  // namespace canopeer::app
