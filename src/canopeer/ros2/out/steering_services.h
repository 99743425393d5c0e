#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"
#include "canopeer/mission/steering_desk.h"
#include "canopeer/ros2/out/motion_consent.h"

namespace canopeer::ros {

/// Steers a mission by services under `~/` (std_srvs/Trigger): start, pause, go_on, next_segment,
/// stop, save, confirm, refuse. Each answers with what happens. Thread-safe.
class SteeringServices : public Steering {
 public:
  struct Parts {
    Node& node;
    MotionConsent& consent;
    /// Writes results so far; says where. In a thread of its own.
    std::function<Expected<std::string>()> save;
    bool wait_for_start = false;
  };
  /// Node and consent outlive it. The error: a service cannot be had.
  [[nodiscard]] static Expected<std::unique_ptr<SteeringServices>> make(Parts parts);

  [[nodiscard]] SteeringWord ask(const SteeringPoint& point) override;
  /// `~/stop` was called.
  [[nodiscard]] bool stop_asked() const { return stop_asked_; }

 private:
  using Trigger = std_srvs::Trigger;
  explicit SteeringServices(Parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] Expected<void> open();
  [[nodiscard]] Trigger::Response say(SteeringWord::Kind kind, const std::string& what_happens);
  [[nodiscard]] Trigger::Response go_on();
  [[nodiscard]] Trigger::Response answer(bool yes);
  void ask_to_save(const Server<Trigger>::Reply& reply);
  void save_when_asked(const std::stop_token& stop);

  Parts parts_;
  SteeringDesk desk_;
  std::atomic<bool> holding_{false};
  std::atomic<bool> stop_asked_{false};
  std::mutex mutex_;
  std::condition_variable_any save_asked_;
  std::optional<Server<Trigger>::Reply> save_for_;  ///< who is told when it is done
  std::vector<Server<Trigger>> servers_;            // their handlers use all above
  std::jthread saver_;                              // first to go: it answers
};

}  // namespace canopeer::ros
