#include "canopeer/ros2/trolley/manual_driver.h"

#include <mutex>
#include <optional>
#include <utility>

#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"

namespace canopeer::ros {
namespace {

using std_srvs::Trigger;

constexpr const char* kService = "~/trolley_arrived";
constexpr double kPersonLook_s = 0.02;

class ManualDriver : public TrolleyDriver {
 public:
  ManualDriver(const TrolleyParts& parts, const Ros2TrolleySettings& settings)
      : parts_(parts), settings_(settings), asked_for_(parts.sense.now()) {}

  Expected<void> serve() {
    auto server = Server<Trigger>::make(
        parts_.node, kService,
        [this](Trigger::Request&&, const Server<Trigger>::Reply& reply) { reply(confirmed()); });
    if (!server) return fail_in(kService, server.error());
    server_.emplace(std::move(*server));
    return {};
  }

  bool at(const TrolleyState& goal) const override {
    const std::lock_guard lock(mutex_);
    return stands_at(asked_for_, goal, 1e-9);
  }

  Expected<void> drive(const TrolleyState& goal) override {
    return wait_for_person(goal, "push the trolley to " + in_words(goal, parts_.robot) +
                                     " (now at " + in_words(parts_.sense.now(), parts_.robot) +
                                     "), then call ");
  }
  Expected<void> confirm_again() override {
    const TrolleyState stands = parts_.sense.now();
    return wait_for_person(stands, "look whether the trolley stands at " +
                                       in_words(stands, parts_.robot) +
                                       ", push it there if not, then call once more ");
  }

  bool in_doubt() const override {
    const std::lock_guard lock(mutex_);
    return doubt_;
  }
  void settle() override {
    const std::lock_guard lock(mutex_);
    doubt_ = false;
  }

 private:
  Expected<void> wait_for_person(const TrolleyState& goal, const std::string& what_to_do) {
    {
      const std::lock_guard lock(mutex_);
      waiting_for_ = goal;
    }
    parts_.person.tell(what_to_do + parts_.node.resolve(kService));
    while (waiting()) {
      if (auto ok = parts_.clock.check(); !ok) return ok;
      if (parts_.person.stop()) {
        const std::lock_guard lock(mutex_);
        waiting_for_.reset();
        return {};
      }
      parts_.clock.sleep(kPersonLook_s);
    }
    return {};
  }
  bool waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_for_.has_value();
  }

  /// A person says that it is there. In the node's thread.
  Trigger::Response confirmed() {
    const std::lock_guard lock(mutex_);
    Trigger::Response response;
    if (!waiting_for_) {
      response.message = "nobody waits for the trolley";
      return response;
    }
    const TrolleyState goal = *waiting_for_;
    const TrolleyState stands = parts_.sense.now_believing(goal);
    if (!stands_at(stands, goal, settings_.manual_tolerance_m)) {
      response.message = "it stands at " + in_words(stands, parts_.robot) + ", not at " +
                         in_words(goal, parts_.robot) + "; push it there and call again";
      return response;
    }
    parts_.sense.believe(goal);
    asked_for_ = goal;
    doubt_ = !parts_.sense.measures_travel();
    waiting_for_.reset();
    response.success = true;
    response.message = "the mission goes on";
    return response;
  }

  TrolleyParts parts_;
  Ros2TrolleySettings settings_;
  mutable std::mutex mutex_;
  TrolleyState asked_for_;  ///< it was there, as a person said
  std::optional<TrolleyState> waiting_for_;
  bool doubt_ = false;
  std::optional<Server<Trigger>> server_;  // last: its handler uses all above
};

}  // namespace

Expected<std::unique_ptr<TrolleyDriver>> make_manual_driver(const TrolleyParts& parts,
                                                            const Ros2TrolleySettings& settings) {
  auto driver = std::make_unique<ManualDriver>(parts, settings);
  if (auto ok = driver->serve(); !ok) return tl::unexpected(ok.error());
  return driver;
}

}  // namespace canopeer::ros
