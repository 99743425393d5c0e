#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// Where each joint was in the last seconds, as joint states say it: rad, or m of a prismatic
/// joint. Joints may be told by different publishers, each at its own rate. Positions are the
/// driver's own count: of joints that turn without end they run on beyond ±π. Thread-safe.
class JointHistory {
 public:
  using Steady = std::chrono::steady_clock;
  struct Sample {
    Stamp stamp = 0;  ///< by the clock of who says it
    double position = 0.0;
  };
  enum class Added {
    taken,
    late,        ///< older than what is known; dropped
    jumped_back  ///< so much older that the clock must have been set: what was known is forgotten
  };

  /// `joints`: names as in the URDF. What is older than `span_s` before the newest is forgotten.
  explicit JointHistory(std::vector<std::string> joints, double span_s = 10.0);

  [[nodiscard]] const std::vector<std::string>& joints() const { return joints_; }
  /// Index of a joint; −1: no such one.
  [[nodiscard]] int index(const std::string& joint) const;

  /// `position` is finite. `received`: when it came in, by our own clock.
  Added add(int joint, const Sample& sample, Steady::time_point received = Steady::now());

  /// All joints at that time, interpolated, in the order of joints(). Nothing: a joint is not known
  /// then (see oldest(), newest()), or its samples lie farther apart than `max_gap_s`.
  [[nodiscard]] std::optional<std::vector<double>> at(Stamp stamp, double max_gap_s = 0.5) const;
  /// The time from which on, and up to which, all joints are known. Nothing: one never was.
  [[nodiscard]] std::optional<Stamp> oldest() const;
  [[nodiscard]] std::optional<Stamp> newest() const;
  /// The last position of each joint; nothing: one is not known yet.
  [[nodiscard]] std::optional<std::vector<double>> last() const;
  /// The samples of one joint from one time to another, both included.
  [[nodiscard]] std::vector<Sample> between(int joint, Stamp from, Stamp to) const;

  /// Since when no joint has been farther than `tolerance` from where it is now. Nothing: a joint
  /// is not known.
  [[nodiscard]] std::optional<Stamp> still_since(double tolerance) const;

  /// How long nothing was heard of the joint that is silent longest, s; infinity: never.
  [[nodiscard]] double silence_s(Steady::time_point now = Steady::now()) const;
  /// Joints of which nothing was heard for longer than `seconds`, or never.
  [[nodiscard]] std::vector<std::string> silent(double seconds,
                                                Steady::time_point now = Steady::now()) const;

 private:
  struct Track {
    std::deque<Sample> samples;  // by time
    std::optional<Steady::time_point> heard;
  };
  const std::vector<std::string> joints_;
  const std::int64_t span_;
  mutable std::mutex mutex_;
  std::vector<Track> tracks_;  // parallel to joints_
};

}  // namespace canopeer::ros
