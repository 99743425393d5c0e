#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace canopeer {

/// What a segment has given so far: by it one without a time limit knows when to end, since few
/// planners say so themselves. A value, part of the mission's state.
class SegmentCourse {
 public:
  static constexpr std::size_t kLastViews = 5;  ///< looked at together …
  static constexpr double kLittle = 0.002;      ///< … they are worth this share of the segment
  static constexpr int kMostWaits = 200;        ///< questions in a row that lead to nothing
  static constexpr int kMostViews = 1000;

  /// `known`: voxels of the map that are known.
  void begin(std::int64_t known) { *this = SegmentCourse(known); }
  void viewed(std::int64_t known) {
    ++views_;
    last_known_.push_back(known);
    if (last_known_.size() > kLastViews + 1) last_known_.erase(last_known_.begin());
  }
  void waited(int questions = 1) { waits_ += questions; }
  void went_on() { waits_ = 0; }

  [[nodiscard]] int views() const { return views_; }
  /// The planner has waited for so long that it will not go on.
  [[nodiscard]] bool waits_for_good() const { return waits_ >= kMostWaits; }
  /// The last views together, frames on the way between them included, made known less than
  /// kLittle of what the whole segment did.
  [[nodiscard]] bool exhausted() const {
    if (views_ >= kMostViews) return true;
    if (last_known_.size() <= kLastViews) return false;
    const auto last = static_cast<double>(last_known_.back() - last_known_.front());
    return last < kLittle * static_cast<double>(last_known_.back() - known_at_begin_);
  }

  SegmentCourse() = default;
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(known_at_begin_, views_, waits_, last_known_);
  }

 private:
  explicit SegmentCourse(std::int64_t known) : known_at_begin_(known) {}

  std::int64_t known_at_begin_ = 0;
  std::int32_t views_ = 0;
  std::int32_t waits_ = 0;
  std::vector<std::int64_t> last_known_;  // after each of the last views
};

}  // namespace canopeer
