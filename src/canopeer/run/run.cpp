#include "canopeer/run/run.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/mission/record_keeper.h"
#include "canopeer/mission/steering_desk.h"
#include "canopeer/record/yardstick_shares.h"
#include "canopeer/run/frame_check.h"
#include "canopeer/run/run_results.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using SteadyClock = std::chrono::steady_clock;

RunHeader header_of(const MissionFile& file) {
  RunHeader header;
  header.canopeer_version = CANOPEER_VERSION;
  header.mission = file.mission.name;
  header.planner = file.mission.planner;
  header.seed = file.mission.seed;
  header.compute_table = file.compute_table;
  header.segments = static_cast<int>(file.mission.segments.size());
  header.segment_time_s = file.mission.segment_time_s;
  header.mission_time_s = file.mission.mission_time_s;
  header.settings_json = file.settings_json;
  header.protocol = file.mission.protocol;
  for (const SegmentPlan& segment : file.mission.segments) {
    header.views_planned += segment.max_views > 0 ? segment.max_views : file.mission.max_views;
  }
  return header;
}

/// The same text, the same run: its settings too.
std::string identity(const RunHeader& h) {
  return h.mission + " " + h.planner + " seed " + std::to_string(h.seed) + ", canopeer " +
         h.canopeer_version + ", compute table " + h.compute_table + " " + h.settings_json;
}

std::string without_settings(const std::string& run) { return run.substr(0, run.find(" {")); }

fs::path out_or_default(fs::path out, const RunHeader& header) {
  if (!out.empty()) return out;
  return fs::path("out") /
         (header.mission + "-" + header.planner + "-seed" + std::to_string(header.seed));
}

}  // namespace

struct Run::State {
  State(std::unique_ptr<Stage> s, fs::path directory)
      : stage(std::move(s)),
        header(header_of(stage->file())),
        out(out_or_default(std::move(directory), header)),
        mission(stage->robot(), stage->site().ports(), stage->file().mission, stage->registries()) {
    Site& site = stage->site();
    site.watch_map(&mission.map());
    site.results_in(out);
    if (auto watcher = site.watcher()) mission.watch(std::move(watcher), {.name = "the site"});
    if (Steering* const steering = site.steering()) steer(*steering);
    if (stage->file().mission.on_the_way.hz > 0.0) mission.keep(frame_check.emplace());
  }

  /// Whether pose and image agree; said aloud where they do not.
  std::optional<FrameAgreement> check_frames() const {
    auto agreement = frame_check ? frame_check->judge() : std::nullopt;
    if (agreement && agreement->wrong() && on_message) {
      const auto& ros2 = stage->file().ros2;
      on_message("notice: " +
                 agreement_text(*agreement, {camera_mounting(stage->robot().model),
                                             ros2 ? ros2->camera.time_offset_s : 0.0}));
    }
    return agreement;
  }

  void steer(Steering& steering) {
    if (!steered) mission.steer(together);
    steered = true;
    together.add(steering);
  }

  SteadyClock::time_point begun;
  std::unique_ptr<tbb::global_control> threads;  // as many as asked for; null: all cores
  std::unique_ptr<Stage> stage;
  RunHeader header;
  fs::path out;
  std::function<void(const std::string& text)> on_message;
  std::optional<RecordKeeper> record;
  std::optional<FrameCheck> frame_check;
  std::optional<Yardstick> yardstick;
  SteeringTogether together;  // outlives the mission
  bool steered = false;
  Mission mission;
  enum class Phase { composed, running, ended } phase = Phase::composed;
  Expected<void> outcome;
};

Run::Run(std::unique_ptr<State> state) : state_(std::move(state)) {}
Run::~Run() = default;

Expected<std::unique_ptr<Run>> Run::compose(const StageRequest& request,
                                            const RunRegistries& registries, fs::path out) {
  auto file = load_mission(request.mission, request.overrides, request.table_dirs, registries);
  if (!file) return tl::unexpected(file.error());
  return compose(std::move(*file), request, registries, std::move(out));
}

Expected<std::unique_ptr<Run>> Run::compose(MissionFile file, const StageRequest& request,
                                            const RunRegistries& registries, fs::path out) {
  const auto begun = SteadyClock::now();
  std::unique_ptr<tbb::global_control> threads;
  if (request.threads > 0) {
    threads = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(request.threads));
  }
  auto stage = Stage::make(std::move(file), request, registries);
  if (!stage) return tl::unexpected(stage.error());
  auto state = std::make_unique<State>(std::move(*stage), std::move(out));
  std::error_code code;
  fs::create_directories(state->out, code);
  if (code) return fail(state->out.string() + ": cannot make the directory: " + code.message());
  state->begun = begun;
  state->on_message = request.callbacks.on_message;
  state->threads = std::move(threads);
  return std::unique_ptr<Run>(new Run(std::move(state)));
}

void Run::watch(std::shared_ptr<Watcher> watcher, const WatchOptions& options) {
  state_->mission.watch(std::move(watcher), options);
}
void Run::keep(Keeper& keeper) { state_->mission.keep(keeper); }
void Run::steer(Steering& steering) { state_->steer(steering); }
Expected<void> Run::hold_against(Yardstick yardstick) {
  const MissionFile& f = file();
  std::optional<std::uint64_t> world_seed;
  if (!f.world.imported()) world_seed = f.mission.seed;
  std::optional<int> fruits;
  if (const Scene* const truth = state_->stage->site().truth()) {
    fruits = static_cast<int>(std::count_if(truth->fruits.begin(), truth->fruits.end(),
                                            [](const FruitTruth& fruit) { return fruit.counted; }));
  }
  const auto fits = check_fits(yardstick, f.mission.name, f.mission.protocol, world_seed, fruits);
  if (fits) state_->yardstick = std::move(yardstick);
  return fits;
}
const Expected<void>& Run::outcome() const { return state_->outcome; }
bool Run::interrupted() const { return state_->record && state_->record->record().interrupted; }
const fs::path& Run::out() const { return state_->out; }
const MissionFile& Run::file() const { return state_->stage->file(); }
Stage& Run::stage() { return *state_->stage; }
const Mission& Run::mission() const { return state_->mission; }
const RunRecord& Run::record() const {
  CANOPEER_CHECK(state_->record.has_value(), "begin() comes first");
  return state_->record->record();
}

Expected<Summary> Run::execute() {
  if (auto ok = begin(); !ok) return tl::unexpected(ok.error());
  while (step()) {
  }
  auto summary = finish();
  if (!outcome()) return tl::unexpected(outcome().error());
  return summary;
}

Expected<void> Run::begin() {
  State& s = *state_;
  if (s.phase != State::Phase::composed) return fail("a run begins once");
  auto keeper = RecordKeeper::create(s.out, s.header);
  if (!keeper) return tl::unexpected(keeper.error());
  s.record.emplace(std::move(*keeper));
  s.mission.keep(*s.record);
  s.phase = State::Phase::running;
  return {};
}

Expected<void> Run::resume(RunState state) {
  State& s = *state_;
  if (s.phase != State::Phase::composed) return fail("a run begins once");
  s.phase = State::Phase::ended;  // until all has gone well
  if (state.run != identity(s.header)) {
    return fail("the state is of another run, or of one with other settings: it is of " +
                without_settings(state.run) + "; this is " + without_settings(identity(s.header)));
  }
  if (auto ok = s.stage->site().restore(state.site); !ok) return fail_in("site", ok.error());
  if (auto ok = s.mission.check(state.mission); !ok) return ok;
  if (s.frame_check) {
    if (auto ok = s.frame_check->restore(state.frame_check); !ok) return ok;
  }
  auto keeper = RecordKeeper::resume(s.out, s.header, state.record_bytes);
  if (!keeper) return tl::unexpected(keeper.error());
  s.record.emplace(std::move(*keeper));
  s.mission.keep(*s.record);
  if (auto ok = s.mission.restore(std::move(state.mission)); !ok) return ok;
  s.phase = State::Phase::running;
  return {};
}

bool Run::step() {
  State& s = *state_;
  CANOPEER_CHECK(s.phase == State::Phase::running, "begin() comes first, finish() last");
  const auto more = s.mission.step();
  if (!more) s.outcome = tl::unexpected(more.error());
  return more.value_or(false);
}

Expected<Summary> Run::finish() {
  State& s = *state_;
  if (s.phase != State::Phase::running) return fail("a run ends once, after begin()");
  s.phase = State::Phase::ended;
  s.stage->site().end_motion();
  if (auto ended = s.mission.end(); !ended && s.outcome) s.outcome = std::move(ended);
  const auto agreement = s.check_frames();
  const std::chrono::duration<double> wall = SteadyClock::now() - s.begun;
  return write_results(s.out, s.record->record(), s.mission, s.stage->site().truth(),
                       s.yardstick ? &*s.yardstick : nullptr, agreement, wall.count());
}

Expected<RunState> Run::state() const {
  const State& s = *state_;
  if (s.phase != State::Phase::running) return fail("only a run under way has a state");
  auto mission = s.mission.state();
  if (!mission) return tl::unexpected(mission.error());
  auto site = s.stage->site().save();
  if (!site) return fail_in("site", site.error());
  return RunState{identity(s.header), std::move(*mission), std::move(*site), s.record->bytes(),
                  s.frame_check ? s.frame_check->save() : std::string()};
}

}  // namespace canopeer
