// Frames as they come: the mission's own FramesOnTheWay, with a camera that plays a film to it,
// while a planner's worker grows a graph and another thread searches one. By the clock; and by the
// processor time of two cores, which is what the clock would say if nobody else used them.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <thread>

#include "bench_threads.h"
#include "canopeer/mission/record_keeper.h"
#include "canopeer/mission/segment/frames_on_the_way.h"
#include "perception_film.h"
#include "perception_load.h"
#include "support/must.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

constexpr int kGraphNodes = 1000;  // of the graph that is searched

double cpu_now_s() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Half the processor time of this process, whose threads have enough to do for two cores.
class TwoCoreClock : public Clock {
 public:
  [[nodiscard]] double now_s() const override { return 0.5 * cpu_now_s() - begin_s_; }
  void charge(double /*compute_s*/) override {}
  void sleep(double seconds) override {
    const double until_s = now_s() + seconds;
    while (now_s() < until_s) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

 private:
  double begin_s_ = 0.5 * cpu_now_s();
};

/// What the camera's film and the mission go by.
enum class By { clock, processor_time };

/// Plays the film: so many frames a second, or the next one whenever somebody asks for frames.
class FilmCamera : public Camera {
 public:
  FilmCamera(const Clock& clock, const TrolleyState& trolley, double hz)
      : clock_(clock), trolley_(trolley), hz_(hz) {}

  Expected<RgbdFrame> capture() override { return fail("it only plays its film"); }
  Expected<void> stream(double hz) override {
    if (hz > 0.0) begin_s_ = clock_.now_s();
    return {};
  }
  Expected<std::vector<StreamedFrame>> arrived() override {
    std::vector<StreamedFrame> frames;
    const double now_s = clock_.now_s();
    while (next_ < film().size()) {
      const double due_s = hz_ > 0.0 ? begin_s_ + static_cast<double>(next_) / hz_ : now_s;
      if (due_s > now_s || (hz_ <= 0.0 && !frames.empty())) break;
      frames.push_back(frame(film()[next_++], due_s));
    }
    return frames;
  }
  [[nodiscard]] bool over() const { return next_ == film().size(); }

 private:
  [[nodiscard]] StreamedFrame frame(const FilmedFrame& filmed, double due_s) const {
    StreamedFrame streamed;
    streamed.time_s = streamed.arrived_s = due_s;
    streamed.intrinsics = filmed.frame.intrinsics;
    streamed.T_world_camera = filmed.frame.T_world_camera;
    streamed.twist = filmed.twist;
    streamed.q = filmed.q;
    streamed.trolley = trolley_;
    streamed.images = [&filmed, due_s]() -> Expected<RgbdFrame> {
      RgbdFrame frame = filmed.frame;
      frame.time_s = due_s;
      return frame;
    };
    return streamed;
  }

  const Clock& clock_;
  TrolleyState trolley_;
  double hz_;
  double begin_s_ = 0.0;
  std::atomic<std::size_t> next_ = 0;
};

/// How long after its arrival each frame was known, with its fruits.
class LatencyKeeper : public Keeper {
 public:
  explicit LatencyKeeper(const Clock& clock) : clock_(clock) {}
  Expected<void> on_event(const Event& event) override {
    if (const auto* frame = std::get_if<FrameOnTheWay>(&event)) {
      took_s_.push_back(clock_.now_s() - frame->frame.t_s);
    }
    return {};
  }
  [[nodiscard]] double percentile_s(double share) {
    std::sort(took_s_.begin(), took_s_.end());
    return took_s_[static_cast<std::size_t>(share * static_cast<double>(took_s_.size()))];
  }

 private:
  const Clock& clock_;
  std::vector<double> took_s_;
};

/// What playing the film came to.
struct Played {
  double seconds = 0.0;  ///< until the last frame was known and told
  double cores = 0.0;    ///< that the process had meanwhile, by the clock
  double latency_p95_s = 0.0;
  FrameCounts counts;
  int nodes = 0;     ///< of the planner's graph at the end
  int searches = 0;  ///< meanwhile
};

/// `hz`: 0: as fast as frames are taken in. `tell_every_s`: how often the planner hears of them.
Played play(By by, double hz, double tell_every_s) {
  static_cast<void>(film());
  const Threads two(2);
  SimulationOptions by_the_clock;
  by_the_clock.realtime = true;
  test::PlanningFixture world(by_the_clock);
  Ports ports = world.simulation.ports();
  const Clock& wall = *ports.clock;
  TwoCoreClock processor_time;
  if (by == By::processor_time) ports.clock = &processor_time;
  FilmCamera camera(*ports.clock, world.frame.trolley, hz);
  ports.camera = &camera;

  world.mission.on_the_way.hz = kFilmHz;
  world.mission.on_the_way.max_blur_px = 0.0;
  world.mission.on_the_way.new_after_m = 0.0;  // all frames count
  world.mission.on_the_way.tell_every_s = tell_every_s;
  const auto snapshot = [&world] {
    return std::make_shared<const MapSnapshot>(world.perception.map(), world.perception.field(),
                                               world.checker);
  };
  const auto planner = begun_planner(
      {},
      planning_scene(world, world.simulation.judge().checker(), world.mission.costs, snapshot()),
      world.home.change);
  SearchLoad search(world, world.home.change.targets, kGraphNodes, snapshot());

  const auto directory = std::filesystem::temp_directory_path() / "canopeer_perception_bench";
  std::filesystem::remove_all(directory);
  auto record = must(RecordKeeper::create(directory, {}));
  LatencyKeeper latency(*ports.clock);
  EventHub events;
  events.keep(record);
  events.keep(latency);

  StageTimer timer;
  Timekeeper time(*ports.clock, world.mission.costs, *planner, 1, timer);
  MissionCursor cursor;
  FramesOnTheWay frames(world.robot, ports, world.mission, world.perception, time, events, cursor);
  frames.plan_with({world.frame.sampling_region_world, [&] {
                      auto now = snapshot();
                      search.look_at(now);
                      return now;
                    }});
  time.background().go();

  const double begin_s = ports.clock->now_s();
  const double begin_wall_s = wall.now_s();
  const double begin_cpu_s = cpu_now_s();
  const int searched = search.searches();
  must(frames.set_out("view"));
  while (!camera.over()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  Played played;
  played.counts = must(frames.arrive()).value();
  played.seconds = ports.clock->now_s() - begin_s;
  played.cores = (cpu_now_s() - begin_cpu_s) / (wall.now_s() - begin_wall_s);
  played.searches = search.searches() - searched;
  time.background().rest();
  played.nodes = planner->status().graph_nodes;
  played.latency_p95_s = latency.percentile_s(0.95);
  std::filesystem::remove_all(directory);
  return played;
}

void say(benchmark::State& state, const Played& played) {
  state.counters["hz"] = played.counts.fused / played.seconds;
  state.counters["cores"] = played.cores;
  state.counters["nodes"] = played.nodes;
  state.counters["searches_per_s"] = played.searches / played.seconds;
  state.counters["p95_ms"] = 1e3 * played.latency_p95_s;
  state.counters["late_percent"] =
      100.0 * played.counts.late / (played.counts.late + played.counts.fused);
}

void sustained(benchmark::State& state, By by, double tell_every_s) {
  for (auto _ : state) {
    const Played played = play(by, 0.0, tell_every_s);
    say(state, played);
    state.SetIterationTime(played.seconds);
  }
}

/// As a mission takes them in.
void sustained_merged(benchmark::State& state) {
  sustained(state, By::clock, OnTheWayOptions().tell_every_s);
}
void sustained_merged_cpu(benchmark::State& state) {
  sustained(state, By::processor_time, OnTheWayOptions().tell_every_s);
}
/// Each as if it were a view: distances, targets, and the planner told.
void sustained_one_by_one(benchmark::State& state) { sustained(state, By::clock, 0.0); }
void sustained_one_by_one_cpu(benchmark::State& state) {
  sustained(state, By::processor_time, 0.0);
}
BENCHMARK(sustained_merged)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(sustained_one_by_one)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(sustained_merged_cpu)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(sustained_one_by_one_cpu)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);

/// Frames at 15 Hz. The best run is that of the lowest 95th percentile.
void latency_by(benchmark::State& state, By by) {
  for (auto _ : state) {
    const Played played = play(by, kFilmHz, OnTheWayOptions().tell_every_s);
    say(state, played);
    state.SetIterationTime(played.latency_p95_s);
  }
}
void latency(benchmark::State& state) { latency_by(state, By::clock); }
void latency_cpu(benchmark::State& state) { latency_by(state, By::processor_time); }
BENCHMARK(latency)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(latency_cpu)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace canopeer
