#include "canopeer/ros2/trolley/topics_driver.h"

#include <algorithm>
#include <array>
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
    const double begun_s = parts_.clock.now_s();
    double said_s = begun_s - kAgain_s;
    double away_s = begun_s;  // last
    while (true) {
      const double now_s = parts_.clock.now_s();
      if (auto ok = parts_.alive(kTopicsSilence_s); !ok) {
        const bool heard = parts_.sense.silent(kTopicsSilence_s).empty();
        command(heard ? parts_.sense.now() : onward(goal));
        return ok;
      }
      if (parts_.person.stop()) {
        command(parts_.sense.now());
        return {};
      }
      if (!at(goal)) away_s = now_s;
      if (now_s - away_s >= kStands_s) return {};
      if (now_s - begun_s > settings_.timeout_s) {
        command(parts_.sense.now());  // nobody watches it from now on
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
  /// Told when nothing was heard of it for a while: about where it is by now, so that it need not
  /// turn back.
  TrolleyState onward(const TrolleyState& goal) const {
    const double most_m = settings_.speed_m_s * kTopicsSilence_s;
    TrolleyState place = parts_.sense.now();
    place.travel_m += std::clamp(goal.travel_m - place.travel_m, -most_m, most_m);
    place.lift_m += std::clamp(goal.lift_m - place.lift_m, -most_m, most_m);
    return place;
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
