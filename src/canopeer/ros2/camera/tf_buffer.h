#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// Where frames were against each other in the last seconds, as /tf and /tf_static say it.
/// Thread-safe. What it keeps is bounded.
class TfBuffer {
 public:
  /// What is older than `span_s` before the newest of a frame is forgotten, and the oldest of the
  /// frame with the most samples when all have more than `most_samples` (2000 or more) together.
  explicit TfBuffer(double span_s = 10.0, std::size_t most_samples = 1'000'000);

  /// Transforms that make no sense (numbers that are none, a frame on itself, no names or too long
  /// ones) are counted and passed over.
  void add(const tf2_msgs::TFMessage& message, bool is_static);
  [[nodiscard]] std::int64_t malformed() const;

  /// T_target_source at that time, each step between its neighbours: position linear, rotation
  /// along the shortest arc. The error: a frame is not known, the two do not hang together, or it
  /// was not known then (by how much too early or late, or neighbours more than 0.5 s apart).
  [[nodiscard]] Expected<Pose> lookup(const std::string& target, const std::string& source,
                                      Stamp stamp) const;
  /// The same with the newest of each step.
  [[nodiscard]] Expected<Pose> newest(const std::string& target, const std::string& source) const;
  /// The time up to which all steps between the two are known; nothing: only static ones, or none.
  [[nodiscard]] std::optional<Stamp> known_until(const std::string& target,
                                                 const std::string& source) const;

  [[nodiscard]] bool has(const std::string& frame) const;
  /// All frames, in alphabetical order.
  [[nodiscard]] std::vector<std::string> frames() const;

 private:
  struct Sample {
    Stamp stamp = 0;
    Pose T_parent_child = Pose::Identity();
  };
  struct Link {
    std::string parent;
    bool is_static = false;
    std::deque<Sample> samples;  // by time; of a static link one
  };
  /// From a frame up to its root, the frame itself first.
  [[nodiscard]] std::vector<std::string> ancestors(const std::string& frame) const;
  /// Frames whose links lead from `source` and from `target` up to where they meet.
  struct Way {
    std::vector<std::string> up_from_source, up_from_target;
  };
  [[nodiscard]] Expected<Way> way(const std::string& target, const std::string& source) const;
  [[nodiscard]] Expected<Pose> step(const std::string& child, std::optional<Stamp> stamp) const;
  [[nodiscard]] Expected<Pose> walk(const std::string& target, const std::string& source,
                                    std::optional<Stamp> stamp) const;

  /// The one with the most samples.
  [[nodiscard]] Link& longest();
  void forget_oldest(Link& link);
  void forget_all(Link& link);

  const std::int64_t span_;
  const std::size_t most_samples_;
  mutable std::mutex mutex_;
  std::map<std::string, Link> links_;  // by child
  std::size_t samples_ = 0;            // of all links
  std::int64_t malformed_ = 0;
};

}  // namespace canopeer::ros
