#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"

namespace canopeer {

/// Where the camera was at one time.
struct TimedPose {
  double time_s = 0.0;  ///< without time stamps: the number of the pose, from 0
  Pose T_world_camera = Pose::Identity();
};

/// Observations that were passed over for want of a pose.
struct PoseGaps {
  int observations = 0;
  double first_s = 0.0;  ///< time stamp of the first of them
  void add(double time_s) {
    if (observations++ == 0) first_s = time_s;
  }
};

/// Where a camera was, and when, as text. A line or comment (#, //, %) may name the columns, as
/// EuRoC, ROS and spreadsheets do; then any order is read. Without names, what a line holds follows
/// from how many numbers it has: `timestamp tx ty tz qx qy qz qw` (TUM), the same without time
/// stamps, or the 12 or 16 numbers of a matrix (KITTI). Matrices of 3 or 4 lines (ICL-NUIM's .sim,
/// Redwood's .log) are read too. Commas and semicolons count as blanks. Time stamps do
/// not fall, and where two are equal the first pose counts; they are in seconds, or in the unit
/// that a name or their size says.
class Trajectory {
 public:
  /// The error names file and line, and what was expected there.
  [[nodiscard]] static Expected<Trajectory> read(const std::filesystem::path& path);
  /// `name` stands for the file in errors.
  [[nodiscard]] static Expected<Trajectory> parse(std::string_view text, const std::string& name);

  [[nodiscard]] const std::vector<TimedPose>& poses() const { return poses_; }
  /// False: no time stamps; the n-th pose is that of the n-th frame.
  [[nodiscard]] bool timed() const { return timed_; }
  /// The time stamps are 0, 1, 2 … or 1, 2, 3 …
  [[nodiscard]] bool counts_frames() const;
  /// What was taken for what, for people.
  [[nodiscard]] const std::string& taken() const { return taken_; }
  /// Names, or matrices, leave no doubt about the order of a quaternion.
  [[nodiscard]] bool order_is_said() const { return order_is_said_; }
  /// What was passed over; each names the file.
  [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }
  /// The pose at that time, between its neighbours: position linear, rotation along the shortest
  /// arc. Nothing before the first pose, after the last one, and where the neighbours are more than
  /// `max_gap_s` apart.
  [[nodiscard]] std::optional<Pose> at(double time_s, double max_gap_s) const;

 private:
  std::vector<TimedPose> poses_;
  std::string taken_;
  std::vector<std::string> notices_;
  bool timed_ = true;
  bool order_is_said_ = false;
};

}  // namespace canopeer
