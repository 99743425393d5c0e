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
      {"~/save", [this] { return save(); }},
      {"~/confirm", [this] { return answer(true); }},
      {"~/refuse", [this] { return answer(false); }}};
  for (const auto& [name, respond] : services) {
    auto server = Server<Trigger>::make(
        parts_.node, name,
        [respond = respond](Trigger::Request&&, const auto& reply) { reply(respond()); });
    if (!server) return fail_in(name, server.error());
    servers_.push_back(std::move(*server));
  }
  return {};
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
  if (kind == Kind::stop) {
    stop_asked_ = true;
    parts_.consent.close();
  }
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

std_srvs::Trigger::Response SteeringServices::save() const {
  const auto saved = parts_.save();
  if (!saved) return {false, saved.error().message};
  return {true, *saved};
}

}  // namespace canopeer::ros
