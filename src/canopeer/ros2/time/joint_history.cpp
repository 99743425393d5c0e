#include "canopeer/ros2/time/joint_history.h"

#include <algorithm>
#include <limits>

namespace canopeer::ros {
namespace {

using Samples = std::deque<JointHistory::Sample>;

/// Publishers overtake each other by milliseconds; by this much only a clock that was set.
constexpr std::int64_t kJump = kNanosecondsPerSecond;

/// The first sample that is not before `stamp`.
auto first_from(const Samples& samples, Stamp stamp) {
  return std::lower_bound(
      samples.begin(), samples.end(), stamp,
      [](const JointHistory::Sample& sample, Stamp at) { return sample.stamp < at; });
}

std::optional<double> interpolate(const Samples& samples, Stamp stamp, std::int64_t max_gap) {
  const auto after = first_from(samples, stamp);
  if (after == samples.end()) return std::nullopt;
  if (after->stamp == stamp) return after->position;
  if (after == samples.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const std::int64_t gap = after->stamp - before->stamp;
  if (gap > max_gap) return std::nullopt;
  const double share = static_cast<double>(stamp - before->stamp) / static_cast<double>(gap);
  return before->position + share * (after->position - before->position);
}

}  // namespace

JointHistory::JointHistory(std::vector<std::string> joints, double span_s)
    : joints_(std::move(joints)), span_(nanoseconds(span_s)), tracks_(joints_.size()) {}

int JointHistory::index(const std::string& joint) const {
  const auto found = std::find(joints_.begin(), joints_.end(), joint);
  return found == joints_.end() ? -1 : static_cast<int>(found - joints_.begin());
}

JointHistory::Added JointHistory::add(int joint, const Sample& sample,
                                      Steady::time_point received) {
  const std::lock_guard lock(mutex_);
  Track& track = tracks_[static_cast<std::size_t>(joint)];
  Added added = Added::taken;
  if (!track.samples.empty() && sample.stamp <= track.samples.back().stamp) {
    if (track.samples.back().stamp - sample.stamp < kJump) return Added::late;
    track.samples.clear();
    added = Added::jumped_back;
  }
  track.samples.push_back(sample);
  track.heard = received;
  while (track.samples.front().stamp < sample.stamp - span_) track.samples.pop_front();
  return added;
}

std::optional<std::vector<double>> JointHistory::at(Stamp stamp, double max_gap_s) const {
  const std::lock_guard lock(mutex_);
  std::vector<double> positions;
  for (const Track& track : tracks_) {
    const auto position = interpolate(track.samples, stamp, nanoseconds(max_gap_s));
    if (!position) return std::nullopt;
    positions.push_back(*position);
  }
  return positions;
}

std::optional<Stamp> JointHistory::oldest() const {
  const std::lock_guard lock(mutex_);
  std::optional<Stamp> oldest;
  for (const Track& track : tracks_) {
    if (track.samples.empty()) return std::nullopt;
    oldest = std::max(oldest.value_or(track.samples.front().stamp), track.samples.front().stamp);
  }
  return oldest;
}

std::optional<Stamp> JointHistory::newest() const {
  const std::lock_guard lock(mutex_);
  std::optional<Stamp> newest;
  for (const Track& track : tracks_) {
    if (track.samples.empty()) return std::nullopt;
    newest = std::min(newest.value_or(track.samples.back().stamp), track.samples.back().stamp);
  }
  return newest;
}

std::optional<std::vector<double>> JointHistory::last() const {
  const std::lock_guard lock(mutex_);
  std::vector<double> positions;
  for (const Track& track : tracks_) {
    if (track.samples.empty()) return std::nullopt;
    positions.push_back(track.samples.back().position);
  }
  return positions;
}

std::vector<JointHistory::Sample> JointHistory::between(int joint, Stamp from, Stamp to) const {
  const std::lock_guard lock(mutex_);
  const Samples& samples = tracks_[static_cast<std::size_t>(joint)].samples;
  std::vector<Sample> found;
  for (auto s = first_from(samples, from); s != samples.end() && s->stamp <= to; ++s) {
    found.push_back(*s);
  }
  return found;
}

std::optional<Stamp> JointHistory::still_since(double tolerance) const {
  const std::lock_guard lock(mutex_);
  std::optional<Stamp> since;
  for (const Track& track : tracks_) {
    if (track.samples.empty()) return std::nullopt;
    const double now = track.samples.back().position;
    auto s = track.samples.rbegin();
    Stamp still = s->stamp;
    for (; s != track.samples.rend() && std::abs(s->position - now) <= tolerance; ++s) {
      still = s->stamp;
    }
    since = std::max(since.value_or(still), still);
  }
  return since;
}

double JointHistory::silence_s(Steady::time_point now) const {
  const std::lock_guard lock(mutex_);
  double longest = 0.0;
  for (const Track& track : tracks_) {
    if (!track.heard) return std::numeric_limits<double>::infinity();
    longest = std::max(longest, std::chrono::duration<double>(now - *track.heard).count());
  }
  return longest;
}

std::vector<std::string> JointHistory::silent(double seconds, Steady::time_point now) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const auto& heard = tracks_[i].heard;
    if (!heard || std::chrono::duration<double>(now - *heard).count() > seconds) {
      names.push_back(joints_[i]);
    }
  }
  return names;
}

}  // namespace canopeer::ros
