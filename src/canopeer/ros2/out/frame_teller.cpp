#include "canopeer/ros2/out/frame_teller.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace canopeer::ros {
namespace {

using namespace std::chrono_literals;

constexpr auto kTfEvery = 50ms;
constexpr int kDescriptionEvery = 20;  // rounds
constexpr const char* kDescription = "robot_description";

/// Sleeps, but not when told to stop.
void pause_for(std::chrono::milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, stop, time, [] { return false; });
}

bool told_by_others(Node& node) {
  const auto publishers = node.publishers_of(kDescription);
  return std::any_of(
      publishers.begin(), publishers.end(),
      [us = node.participant().id()](const Endpoint& e) { return participant_of(e.guid) != us; });
}

}  // namespace

Expected<std::unique_ptr<FrameTeller>> FrameTeller::make(Parts parts,
                                                         const Ros2OutputSettings& settings) {
  std::unique_ptr<FrameTeller> teller(new FrameTeller(std::move(parts), settings));
  if (auto ok = teller->open(); !ok) return tl::unexpected(ok.error());
  return teller;
}

Expected<void> FrameTeller::open() {
  if (settings_.tf) {
    if (auto ok = others_.listen(parts_.node); !ok) return ok;
    auto tf = parts_.node.advertise<tf2_msgs::TFMessage>("/tf", kTfQos);
    if (!tf) return fail_in("/tf", tf.error());
    tf_ = std::move(*tf);
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  return {};
}

void FrameTeller::run(const std::stop_token& stop) {
  pause_for(parts_.listen_first, stop);
  for (int round = 0; !stop.stop_requested(); ++round) {
    if (settings_.tf) tell_frames();
    if (settings_.robot_description && round % kDescriptionEvery == 0) tell_description();
    pause_for(kTfEvery, stop);
  }
}

void FrameTeller::tell_frames() {
  const auto place = parts_.where();
  if (!place) return;
  tf2_msgs::TFMessage message;
  message.transforms = missing_frames(parts_.robot, *place, settings_.map_frame, others_.known(),
                                      parts_.clock.now());
  if (!message.transforms.empty()) tf_.publish(message);
}

void FrameTeller::tell_description() {
  if (parts_.description.empty()) return;
  if (told_by_others(parts_.node)) {
    description_.reset();
  } else if (!description_) {
    auto publisher = parts_.node.advertise<std_msgs::String>(kDescription, kLatchedQos);
    if (!publisher) return;  // tried again in the next round
    publisher->publish({parts_.description});
    description_ = std::move(*publisher);
  }
}

}  // namespace canopeer::ros
