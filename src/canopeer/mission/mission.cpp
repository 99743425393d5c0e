#include "canopeer/mission/mission.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/mission/mission_time.h"
#include "canopeer/mission/segment/segment_runner.h"
#include "canopeer/robot/arm_reach.h"

namespace canopeer {
namespace {

using Step = MissionCursor::Step;
using Word = SteeringWord::Kind;

constexpr std::chrono::milliseconds kHold(20);  // between two questions while a mission holds

/// Where the distance field ends nothing is known to be in the way, so it reaches as far as the
/// arm.
MissionOptions with_reach_of(const RobotModel& robot, MissionOptions options) {
  options.field_reach_m = std::max(options.field_reach_m, arm_reach_m(robot));
  return options;
}

}  // namespace

struct Mission::State {
  State(const RobotKit& kit, const Ports& p, const MissionOptions& o, const Registries& r)
      : robot(kit),
        ports(p),
        options(with_reach_of(kit.model, o)),
        registries(r),
        perception(options, r.detectors),
        traveller(kit.model, o.motion, o.seed),
        camera(kit.model, ports, options, perception) {
    if (options.mission_time_s > 0.0) deadlines_s = segment_deadlines_s(kit.model, options);
  }

  // What the mission is made of …
  RobotKit robot;
  Ports ports;
  MissionOptions options;
  std::vector<double> deadlines_s;  ///< of the segments; empty: each has its own clock
  Registries registries;
  Perception perception;
  Traveller traveller;
  FrameTaker camera;
  EventHub events;
  StageTimer timer;
  Steering* steering = nullptr;
  // … from the first step on …
  std::unique_ptr<Planner> planner;
  std::unique_ptr<Timekeeper> time;
  std::unique_ptr<FramesOnTheWay> frames;
  std::unique_ptr<ArmMover> arm;
  std::unique_ptr<SegmentRunner> segment;  ///< the last one begun
  // … and where it is.
  enum class Phase { fresh, running, failed, ended };
  Phase phase = Phase::fresh;
  MissionCursor cursor;
  SteeringWord said;  ///< last

  [[nodiscard]] SegmentTools tools() {
    return {robot, options, perception, camera, *arm, *frames, *time, events, cursor, deadlines_s};
  }
  [[nodiscard]] Configuration home_of(int index) const {
    const auto& plan = options.segments[static_cast<std::size_t>(index)];
    return robot.model.home("side_" + std::to_string(plan.side));
  }
  /// Nothing that is seen now counts.
  [[nodiscard]] bool over() const {
    return !deadlines_s.empty() && ports.clock->now_s() >= deadlines_s.back() + cursor.held_s;
  }
  [[nodiscard]] int segments() const { return static_cast<int>(options.segments.size()); }

  Expected<void> restore(MissionState state);
  Expected<void> prepare();
  Expected<void> take_step();
  Expected<void> do_step();
  Expected<void> drive();
  Expected<void> begin();
  Expected<void> decide();
  Expected<void> go_home();
  Expected<void> listen_to_steering();
  Expected<void> say(const SteeringWord& word);
  [[nodiscard]] SteeringPoint steering_point(bool holding) const;
};

Mission::Mission(const RobotKit& robot, const Ports& ports, const MissionOptions& options,
                 const Registries& registries)
    : state_(std::make_unique<State>(robot, ports, options, registries)) {}
Mission::~Mission() = default;

void Mission::keep(Keeper& keeper) {
  CANOPEER_CHECK(state_->phase == State::Phase::fresh, "keepers join before the first step");
  state_->events.keep(keeper);
}
void Mission::watch(std::shared_ptr<Watcher> watcher, const WatchOptions& options) {
  CANOPEER_CHECK(state_->phase == State::Phase::fresh, "watchers join before the first step");
  state_->events.watch(std::move(watcher), options, state_->ports.clock->simulated());
}
void Mission::steer(Steering& steering) {
  CANOPEER_CHECK(state_->steering == nullptr, "one steers; SteeringTogether takes several");
  state_->steering = &steering;
}
const MissionCursor& Mission::cursor() const { return state_->cursor; }
const VoxelMap& Mission::map() const { return state_->perception.map(); }
const FruitMap& Mission::fruits() const { return state_->perception.fruits(); }
const StageTimer& Mission::timer() const { return state_->timer; }
std::vector<EventHub::Watched> Mission::watched() const { return state_->events.watched(); }

Expected<void> Mission::run() {
  Expected<bool> more = true;
  while (more && *more) more = step();
  const Expected<void> ended = end();
  if (!more) return tl::unexpected(more.error());
  return ended;
}

Expected<bool> Mission::step() {
  State& s = *state_;
  if (s.phase == State::Phase::failed || s.phase == State::Phase::ended) {
    return fail("the mission has ended");
  }
  if (s.cursor.next == Step::done) return false;
  auto ok = s.take_step();
  if (ok) return s.cursor.next != Step::done;
  s.phase = State::Phase::failed;
  // The keepers' own errors must not hide the first one.
  static_cast<void>(s.events.emit(Fault{s.ports.clock->now_s(), ok.error().message}));
  return tl::unexpected(ok.error());
}

Expected<void> Mission::end() {
  State& s = *state_;
  if (s.phase == State::Phase::ended) return fail("the mission has ended");
  s.phase = State::Phase::ended;
  const bool interrupted = s.cursor.stopped || s.cursor.next != Step::done;
  if (s.frames) s.frames->abandon();
  s.segment.reset();
  s.perception.finish(s.timer);
  const double end_s = s.ports.clock->now_s();
  Expected<void> ok;
  const auto tell = [&](Event event) {
    if (auto told = s.events.emit(std::move(event)); !told && ok) ok = std::move(told);
  };
  tell(FruitsFound{end_s, s.cursor.views - 1, s.perception.fruits().fruits()});
  if (s.time) {
    s.time->book(&TimeSplit::transitions_s);
    tell(WorkDone{s.time->work_items(), s.time->meters().time});
  }
  RunEnded ended{end_s, interrupted};
  if (s.events.needs().surface) {
    ended.surface = std::make_shared<const SurfaceMesh>(s.perception.fruits().surface());
  }
  tell(std::move(ended));
  s.events.finish();
  return ok;
}

/// What needs the planner is made with it: its name may be unknown.
Expected<void> Mission::State::prepare() {
  phase = Phase::running;
  auto made = registries.planners.make(options.planner, options.planners);
  if (!made) return tl::unexpected(made.error());
  planner = std::move(*made);
  time = std::make_unique<Timekeeper>(*ports.clock, options.costs, *planner,
                                      options.background_workers, timer);
  frames = std::make_unique<FramesOnTheWay>(robot.model, ports, options, perception, *time, events,
                                            cursor);
  arm = std::make_unique<ArmMover>(robot.model, ports, traveller, *time, *frames, events, cursor,
                                   options.on_the_way.limit());
  if (frames->wanted()) {  // said before anything moves
    if (auto ok = ports.camera->stream(options.on_the_way.hz); !ok) {
      return fail_in("camera", ok.error());
    }
    if (auto ok = ports.camera->stream(0.0); !ok) return fail_in("camera", ok.error());
  }
  if (traveller.state().way.empty()) traveller.forget_way(ports.arm->configuration());
  return {};
}

/// What comes from outside may throw: that ends the run like any other failure.
Expected<void> Mission::State::take_step() {
  try {
    if (phase == Phase::fresh) {
      if (auto ok = prepare(); !ok) return ok;
      if (auto ok = events.emit(
              RunBegun{time->now_s(), segments(), options.segment_time_s, false, std::nullopt});
          !ok) {
        return ok;
      }
    }
    return do_step();
  } catch (const std::exception& error) {
    if (frames) frames->abandon();
    return fail(std::string("an exception: ") + error.what());
  }
}

Expected<void> Mission::State::do_step() {
  if (auto ok = listen_to_steering(); !ok) return ok;
  switch (cursor.next) {
    case Step::drive:
      return drive();
    case Step::begin:
      return begin();
    case Step::decide:
      return decide();
    case Step::go_home:
      return go_home();
    case Step::done:
      break;
  }
  return {};
}

Expected<void> Mission::State::drive() {
  cursor.next = cursor.stopped ? Step::done : Step::begin;
  if (cursor.stopped) return {};
  return arm->drive({options.segments[static_cast<std::size_t>(cursor.segment)].trolley});
}

Expected<void> Mission::State::begin() {
  const bool ends = cursor.stopped || over();
  cursor.next = ends ? Step::done : Step::decide;
  if (ends) return {};
  segment.reset();
  segment = std::make_unique<SegmentRunner>(tools(), cursor.segment);
  return segment->begin();
}

Expected<void> Mission::State::decide() {
  if (!cursor.stopped && !cursor.skip && !segment->is_over()) return segment->step();
  cursor.next = Step::go_home;
  cursor.skip = false;
  return segment->end();
}

/// The arm goes to the next segment's home at once: it is home before the trolley moves.
Expected<void> Mission::State::go_home() {
  const int next = std::min(cursor.segment + 1, segments() - 1);
  const auto end = segment->go_home(home_of(next));
  if (!end) return tl::unexpected(end.error());
  // What was withheld stays so in a dry run: on with the next segment, from where the arm is.
  if (*end != MotionEnd::arrived && *end != MotionEnd::withheld) return {};  // once more
  const bool last = cursor.segment + 1 == segments() || over();
  cursor.next = last || cursor.stopped ? Step::done : Step::drive;
  if (cursor.next == Step::drive) ++cursor.segment;
  time->book(&TimeSplit::transitions_s);
  return events.emit(WorkDone{time->work_items(), time->meters().time});
}

/// Asks what to do, and holds as long as the answer says so. A hold takes nothing from the segment.
Expected<void> Mission::State::listen_to_steering() {
  if (steering == nullptr) return {};
  const double since_s = ports.clock->now_s();
  bool held = false;
  SteeringWord word = steering->ask(steering_point(false));
  cursor.needs_person.clear();
  while (true) {
    if (auto ok = say(word); !ok) return ok;
    if (word.kind != Word::pause && word.kind != Word::wait_for_person) break;
    if (!std::exchange(held, true)) time->background().hold();
    std::this_thread::sleep_for(kHold);
    word = steering->ask(steering_point(true));
  }
  if (held) time->background().resume();
  cursor.held_s += ports.clock->now_s() - since_s;
  if (time) time->held(ports.clock->now_s() - since_s);
  cursor.segment_start_s += ports.clock->now_s() - since_s;
  cursor.standing_since_s += ports.clock->now_s() - since_s;
  cursor.stopped = cursor.stopped || word.kind == Word::stop;
  // Who is on the way home goes to the next segment already.
  cursor.skip = cursor.next != Step::go_home && (cursor.skip || word.kind == Word::next_segment);
  return {};
}

/// A word that is new is an event.
Expected<void> Mission::State::say(const SteeringWord& word) {
  const bool idle =
      word.kind == Word::next_segment && (cursor.skip || cursor.next == Step::go_home);
  const bool same = word.kind == cursor.said &&
                    (word.kind == Word::go_on || (word.by == said.by && word.why == said.why));
  // A state keeps the kind only: the first answer after it is not news when that is the same.
  const bool known = same || (word.kind == cursor.said && said.kind != cursor.said);
  said = word;
  cursor.said = word.kind == Word::next_segment ? Word::go_on : word.kind;
  if (idle || known) return {};
  return events.emit(Steered{ports.clock->now_s(), cursor.segment, word});
}

SteeringPoint Mission::State::steering_point(bool holding) const {
  SteeringPoint point;
  point.t_s = ports.clock->now_s();
  point.segment = cursor.segment;
  point.segment_time_s = point.t_s - cursor.segment_start_s;
  point.next = step_name(cursor.next);
  point.views = cursor.views;
  point.fruits = static_cast<int>(perception.fruits().fruits().size());
  point.holding = holding;
  point.needs_person = cursor.needs_person;
  return point;
}

Expected<MissionState> Mission::state() const {
  const State& s = *state_;
  if (s.phase == State::Phase::failed) return fail("a mission that failed cannot go on");
  if (s.options.background_workers > 0 || !s.ports.clock->simulated()) {
    return fail("only a mission in simulated time can go on from a state");
  }
  MissionState state{s.cursor,
                     {},
                     s.traveller.state(),
                     s.perception.map(),
                     s.perception.unsettled(),
                     s.perception.fruits(),
                     {}};
  if (s.time) state.meters = s.time->meters();
  if (s.segment) {
    auto planner = s.planner->state();
    if (!planner) return fail_in("planner '" + s.options.planner + "'", planner.error());
    state.planner = std::move(*planner);
  }
  return state;
}

Expected<void> Mission::check(const MissionState& state) const {
  const MissionCursor& at = state.cursor;
  if (at.segment < 0 || at.segment >= state_->segments()) {
    return fail("the state is of a mission with other segments");
  }
  const bool within = at.next == Step::decide || at.next == Step::go_home;
  if (within && !state.planner) return fail("the state has no planner, in the middle of a segment");
  return {};
}

Expected<void> Mission::restore(MissionState state) {
  State& s = *state_;
  if (s.phase != State::Phase::fresh) return fail("a mission is restored before its first step");
  if (auto ok = check(state); !ok) return ok;
  const auto ok = s.restore(std::move(state));
  if (!ok) s.phase = State::Phase::failed;
  return ok;
}

Expected<void> Mission::State::restore(MissionState state) {
  cursor = state.cursor;
  traveller.restore(std::move(state.traveller));
  perception.restore(std::move(state.map), std::move(state.fruits), std::move(state.unsettled));
  if (auto ok = prepare(); !ok) return ok;
  time->set_meters(state.meters);
  RunBegun begun{time->now_s(), segments(), options.segment_time_s, true, std::nullopt};
  if (state.planner) {
    // Between two segments the planner is still in the last one.
    const bool between = cursor.next == Step::drive || cursor.next == Step::begin;
    segment = std::make_unique<SegmentRunner>(tools(), std::max(0, cursor.segment - between));
    if (auto ok = segment->resume(*state.planner); !ok) return ok;
    if (!between && cursor.next != Step::done) begun.segment = segment->event();
  }
  return events.emit(std::move(begun));
}

}  // namespace canopeer
