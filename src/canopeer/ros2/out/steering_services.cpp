#include "canopeer/ros2/out/steering_services.h"

#include <utility>

namespace canopeer::ros {
namespace {

using Kind = SteeringWord::Kind;
constexpr const char* kBy = "service";

}  // namespace

Expected<std::unique_ptr<SteeringServices>> SteeringServices::make(Parts parts) {
  std::unique_ptr<SteeringServices> services(new SteeringServices(std::move(parts)));
  if (services->parts_.wait_for_start) {
    services->holding_ = true;
    services->desk_.say({Kind::wait_for_person, kBy, "call ~/start"});
  }
  if (auto ok = services->open(); !ok) return tl::unexpected(ok.error());
  return services;
}

Expected<void> SteeringServices::open() {
  const std::pair<const char*, std::function<Trigger::Response()>> services[] = {
      {"~/start", [this] { return go_on(); }},
      {"~/go_on", [this] { return go_on(); }},
      {"~/pause",
       [this] {
         return say(Kind::pause, "the mission pauses before its next step; a motion ends first");
       }},
      {"~/next_segment",
       [this] {
         return say(Kind::next_segment, "the segment ends before its next step; the arm goes home");
       }},
      {"~/stop",
       [this] {
         return say(Kind::stop,
                    "what moves is stopped; the arm goes home, the results are written");
       }},
      {"~/confirm", [this] { return answer(true); }},
      {"~/refuse", [this] { return answer(false); }}};
  const auto serve = [this](const char* name, Server<Trigger>::Handler handler) -> Expected<void> {
    auto server = Server<Trigger>::make(parts_.node, name, std::move(handler));
    if (!server) return fail_in(name, server.error());
    servers_.push_back(std::move(*server));
    return {};
  };
  for (const auto& [name, respond] : services) {
    auto handler = [answer = respond](Trigger::Request&&, const auto& reply) { reply(answer()); };
    if (auto ok = serve(name, handler); !ok) return ok;
  }
  saver_ = std::jthread([this](const std::stop_token& stop) { save_when_asked(stop); });
  return serve("~/save", [this](Trigger::Request&&, const auto& reply) { ask_to_save(reply); });
}

SteeringWord SteeringServices::ask(const SteeringPoint& point) {
  SteeringWord word = desk_.ask(point);
  holding_ = word.kind == Kind::pause || word.kind == Kind::wait_for_person;
  return word;
}

std_srvs::Trigger::Response SteeringServices::say(Kind kind, const std::string& what_happens) {
  if (stop_asked_) return {false, "the run has been told to stop already"};
  desk_.say({kind, kBy, ""});
  if (kind == Kind::pause) holding_ = true;
  if (kind == Kind::stop) stop_asked_ = true;
  return {true, what_happens};
}

std_srvs::Trigger::Response SteeringServices::go_on() {
  if (stop_asked_) return {false, "the run has been told to stop; begin another one"};
  if (!holding_.exchange(false)) return {true, "the mission goes on; nothing held it"};
  desk_.say({Kind::go_on, kBy, ""});
  return {true, "the mission goes on"};
}

std_srvs::Trigger::Response SteeringServices::answer(bool yes) {
  const auto question = parts_.consent.question();
  if (!question || !parts_.consent.answer(yes)) return {false, "nothing waits for an answer"};
  return {true, (yes ? "allowed: " : "refused: ") + *question};
}

void SteeringServices::ask_to_save(const Server<Trigger>::Reply& reply) {
  {
    const std::lock_guard lock(mutex_);
    if (save_for_) return reply({false, "results are being written already"});
    save_for_ = reply;
  }
  save_asked_.notify_all();
}

/// In a thread of its own: writing a map takes longer than joint states may wait behind it.
void SteeringServices::save_when_asked(const std::stop_token& stop) {
  while (true) {
    std::unique_lock lock(mutex_);
    if (!save_asked_.wait(lock, stop, [&] { return save_for_.has_value(); })) return;
    lock.unlock();
    const auto saved = parts_.save();
    lock.lock();
    const auto reply = *std::exchange(save_for_, std::nullopt);
    lock.unlock();
    reply(saved ? Trigger::Response{true, *saved}
                : Trigger::Response{false, saved.error().message});
  }
}

}  // namespace canopeer::ros
