#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/log.h"
#include "canopeer/mission/listeners.h"
#include "canopeer/ros2/time/ros_clock.h"

namespace canopeer::ros {

/// Tells others on ROS 2 what a mission does: topics under `~/`, /rosout, /diagnostics
/// (docs/formats.md). Events are but taken note of; a thread of its own makes messages of them when
/// they are due and somebody reads them. Thread-safe.
class Ros2Watcher : public Watcher {
 public:
  /// Node and clock are kept as long as the watcher lives.
  struct Parts {
    std::shared_ptr<Node> node;
    std::shared_ptr<const RosClock> clock;
    Ros2OutputSettings settings;
    std::string camera_frame;  ///< optical frame, of pictures
  };
  /// The error: a topic cannot be had.
  [[nodiscard]] static Expected<std::shared_ptr<Ros2Watcher>> make(Parts parts);
  ~Ros2Watcher() override;

  [[nodiscard]] EventNeeds needs() const override { return {.map = true, .plan = true}; }
  void on_event(const Event& event) override;
  void on_loss(std::int64_t events) override;

  /// A line on /rosout.
  void say(LogLevel level, const std::string& text);
  /// At most so many a second from now on; 0: none.
  void set_rates(double map_rate_hz, double image_rate_hz);
  /// Writes map and fruits as they are known now into `folder`, which is made: map.ot, map_roi.ot,
  /// fruits.csv, fruits.json. The error: there is nothing yet, or a file cannot be written.
  [[nodiscard]] Expected<std::vector<std::filesystem::path>> save(
      const std::filesystem::path& folder) const;

 private:
  struct State;
  explicit Ros2Watcher(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace canopeer::ros
