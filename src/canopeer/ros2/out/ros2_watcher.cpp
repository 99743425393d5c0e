#include "canopeer/ros2/out/ros2_watcher.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "canopeer/ros2/out/event_words.h"
#include "canopeer/ros2/out/message_parts.h"
#include "canopeer/ros2/out/network_diagnostics.h"
#include "canopeer/ros2/out/progress.h"
#include "canopeer/ros2/out/saved_results.h"
#include "canopeer/ros2/out/told_topics.h"

namespace canopeer::ros {
namespace {

using TellingClock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kLook = 50ms;        // for what is due
constexpr auto kAtLeastEvery = 1s;  // progress; diagnostics no oftener

/// What happened since the thread looked last; of most only the last one counts.
struct News {
  std::optional<MapChanged> map;
  std::optional<FruitsFound> fruits;
  std::optional<Planned> plan;
  std::optional<FrameTaken> frame;
  bool progress = false;
  bool ended = false;
};

}  // namespace

struct Ros2Watcher::State {
  explicit State(Parts all) : parts(std::move(all)) {
    rates = {parts.settings.map_rate_hz, parts.settings.image_rate_hz};
  }

  Parts parts;
  std::optional<Log> log;
  Publisher<std_msgs::String> progress_out;
  Publisher<diagnostic_msgs::DiagnosticArray> diagnostics_out;
  ToldTopics topics;  // of the thread

  mutable std::mutex mutex;
  std::condition_variable_any changed;
  News news;
  Progress progress;
  ToldTopics::Rates rates;
  std::shared_ptr<const VoxelMap> map;  // the last ones
  std::vector<FruitEstimate> fruits;
  std::jthread thread;  // first to go

  Expected<void> open();
  void note(const Event& event);
  void run(const std::stop_token& stop);
  void offer(const News& what);
  void tell_progress();
  void tell_diagnostics();

  [[nodiscard]] Stamp stamp_at(double mission_s) const {
    return parts.clock->now() - nanoseconds(parts.clock->now_s() - mission_s);
  }
  [[nodiscard]] std_msgs::Header in_map(double mission_s) const {
    return header_of(parts.settings.map_frame, stamp_at(mission_s));
  }
};

Expected<void> Ros2Watcher::State::open() {
  Node& node = *parts.node;
  auto said = Log::make(node, [clock = parts.clock] { return ros_time(clock->now()); });
  if (!said) return fail_in("/rosout", said.error());
  log.emplace(std::move(*said));
  if (!parts.settings.enabled) return {};  // what has no topic is not told
  auto progress_publisher = node.advertise<std_msgs::String>("~/progress", kLatchedQos);
  if (!progress_publisher) return fail_in("~/progress", progress_publisher.error());
  progress_out = std::move(*progress_publisher);
  auto diagnostics = node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics");
  if (!diagnostics) return fail_in("/diagnostics", diagnostics.error());
  diagnostics_out = std::move(*diagnostics);
  return topics.open(node);
}

/// In the mission's watching thread; the lock is held.
void Ros2Watcher::State::note(const Event& event) {
  progress.add(event);
  news.progress = true;
  if (const auto* changed_map = std::get_if<MapChanged>(&event)) {
    news.map = *changed_map;
    if (changed_map->map != nullptr) map = changed_map->map;
  } else if (const auto* found = std::get_if<FruitsFound>(&event)) {
    news.fruits = *found;
    fruits = found->fruits;
  } else if (const auto* planned = std::get_if<Planned>(&event)) {
    news.plan = *planned;
  } else if (const auto* taken = std::get_if<FrameTaken>(&event)) {
    news.frame = *taken;
  } else if (std::holds_alternative<RunEnded>(event)) {
    news.ended = true;
  }
}

void Ros2Watcher::State::run(const std::stop_token& stop) {
  TellingClock::time_point told{};
  while (true) {
    News what;
    ToldTopics::Rates at_most;
    {
      std::unique_lock lock(mutex);
      changed.wait_for(lock, stop, kLook, [&] { return news.progress; });
      what = std::exchange(news, {});
      at_most = rates;
    }
    offer(what);
    const bool last = what.ended || stop.stop_requested();
    last ? topics.tell_all(at_most) : topics.tell_what_is_due(at_most);
    const bool due = last || TellingClock::now() - told >= kAtLeastEvery;
    if (due || what.progress) tell_progress();
    if (due) {
      tell_diagnostics();
      told = TellingClock::now();
    }
    if (stop.stop_requested()) return;
  }
}

void Ros2Watcher::State::offer(const News& what) {
  if (what.map) topics.offer(*what.map, in_map(what.map->t_s));
  if (what.fruits) topics.offer(*what.fruits, in_map(what.fruits->t_s));
  if (what.plan) topics.offer(*what.plan, in_map(what.plan->t_s));
  if (what.frame) {
    const Stamp stamp = stamp_at(what.frame->view.t_s);
    topics.offer(*what.frame, header_of(parts.settings.map_frame, stamp),
                 header_of(parts.camera_frame, stamp));
  }
}

void Ros2Watcher::State::tell_progress() {
  std_msgs::String text;
  {
    const std::lock_guard lock(mutex);
    text.data = progress.json();
  }
  progress_out.publish(text);
}

void Ros2Watcher::State::tell_diagnostics() {
  if (diagnostics_out.readers() == 0) return;
  diagnostic_msgs::DiagnosticArray diagnostics;
  {
    const std::lock_guard lock(mutex);
    diagnostics.status = progress.diagnostics(parts.node->options().name);
  }
  diagnostics.header.stamp = ros_time(parts.clock->now());
  diagnostics.status.push_back(network_diagnostics(*parts.node));
  diagnostics_out.publish(diagnostics);
}

Ros2Watcher::Ros2Watcher(std::unique_ptr<State> state) : state_(std::move(state)) {
  state_->thread = std::jthread([s = state_.get()](const std::stop_token& stop) { s->run(stop); });
}
Ros2Watcher::~Ros2Watcher() = default;

Expected<std::shared_ptr<Ros2Watcher>> Ros2Watcher::make(Parts parts) {
  auto state = std::make_unique<State>(std::move(parts));
  if (auto ok = state->open(); !ok) return tl::unexpected(ok.error());
  return std::shared_ptr<Ros2Watcher>(new Ros2Watcher(std::move(state)));
}

void Ros2Watcher::on_event(const Event& event) {
  if (const auto words = words_of(event)) say(static_cast<LogLevel>(words->level), words->text);
  {
    const std::lock_guard lock(state_->mutex);
    state_->note(event);
  }
  state_->changed.notify_all();
}

void Ros2Watcher::on_loss(std::int64_t events) {
  const std::lock_guard lock(state_->mutex);
  state_->progress.add_loss(events);
}

void Ros2Watcher::say(LogLevel level, const std::string& text) { state_->log->say(level, text); }

void Ros2Watcher::set_rates(double map_rate_hz, double image_rate_hz) {
  const std::lock_guard lock(state_->mutex);
  state_->rates = {map_rate_hz, image_rate_hz};
}

Expected<std::vector<std::filesystem::path>> Ros2Watcher::save(
    const std::filesystem::path& folder) const {
  std::shared_ptr<const VoxelMap> map;
  std::vector<FruitEstimate> fruits;
  {
    const std::lock_guard lock(state_->mutex);
    map = state_->map;
    fruits = state_->fruits;
  }
  if (map == nullptr) return fail("nothing was mapped yet");
  return save_results(folder, *map, fruits);
}

}  // namespace canopeer::ros
