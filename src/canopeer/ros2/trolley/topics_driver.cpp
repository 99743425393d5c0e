#include "canopeer/ros2/trolley/topics_driver.h"

#include <optional>
#include <utility>

#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr double kTopicsSilence_s = 2.0;  // such topics may be slow
constexpr double kStands_s = 0.3;         // at the goal, to have arrived
constexpr double kAgain_s = 1.0;          // the command is said again
constexpr double kTopicsLook_s = 0.02;

class TopicsDriver : public TrolleyDriver {
 public:
  struct Command {
    std::string topic;
    Publisher<std_msgs::Float64> publisher;
  };
  TopicsDriver(const TrolleyParts& parts, const Ros2TrolleySettings& settings,
               std::optional<Command> travel, std::optional<Command> lift)
      : parts_(parts), settings_(settings), travel_(std::move(travel)), lift_(std::move(lift)) {}

  std::vector<std::string> missing() const override {
    std::vector<std::string> missing;
    for (const auto& command : {&travel_, &lift_}) {
      if (!*command || (*command)->publisher.readers() > 0) continue;
      missing.push_back("a subscriber of " + (*command)->topic + " (std_msgs/msg/Float64)");
    }
    return missing;
  }
  bool at(const TrolleyState& goal) const override {
    return stands_at(parts_.sense.now(), goal, settings_.tolerance_m);
  }

  Expected<void> drive(const TrolleyState& goal) override {
    const bool stop_was_asked = parts_.person.stop();
    const double begun_s = parts_.clock.now_s();
    double said_s = begun_s - kAgain_s;
    double away_s = begun_s;  // last
    while (true) {
      const double now_s = parts_.clock.now_s();
      if (auto ok = alive(); !ok) {
        command(parts_.sense.now());
        return ok;
      }
      if (!stop_was_asked && parts_.person.stop()) {
        command(parts_.sense.now());
        return {};
      }
      if (!at(goal)) away_s = now_s;
      if (now_s - away_s >= kStands_s) return {};
      if (now_s - begun_s > settings_.timeout_s) {
        return fail("it did not arrive within " + figure(settings_.timeout_s, 0) +
                    " s (ros2.trolley.timeout_s); it stands at " +
                    in_words(parts_.sense.now(), parts_.robot));
      }
      if (now_s - said_s >= kAgain_s) {
        command(goal);
        said_s = now_s;
      }
      parts_.clock.sleep(kTopicsLook_s);
    }
  }

 private:
  void command(const TrolleyState& goal) const {
    if (travel_) travel_->publisher.publish({goal.travel_m});
    if (lift_) lift_->publisher.publish({goal.lift_m});
  }
  Expected<void> alive() const {
    if (auto ok = parts_.clock.check(); !ok) return ok;
    const auto silent = parts_.sense.silent(kTopicsSilence_s);
    if (silent.empty()) return {};
    return fail("lost it: nothing was heard of " + silent.front() + " for " +
                figure(kTopicsSilence_s, 1) + " s");
  }

  TrolleyParts parts_;
  Ros2TrolleySettings settings_;
  std::optional<Command> travel_;
  std::optional<Command> lift_;
};

}  // namespace

Expected<std::unique_ptr<TrolleyDriver>> make_topics_driver(const TrolleyParts& parts,
                                                            const Ros2TrolleySettings& settings) {
  std::array<std::optional<TopicsDriver::Command>, 2> commands;
  const std::array<const std::string*, 2> topics = {&settings.travel_command,
                                                    &settings.lift_command};
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i]->empty()) continue;
    auto publisher = parts.node.advertise<std_msgs::Float64>(*topics[i]);
    if (!publisher) return fail_in(*topics[i], publisher.error());
    commands[i] = TopicsDriver::Command{*topics[i], std::move(*publisher)};
  }
  return std::make_unique<TopicsDriver>(parts, settings, std::move(commands[0]),
                                        std::move(commands[1]));
}

}  // namespace canopeer::ros
