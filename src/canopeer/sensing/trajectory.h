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
  double time_s = 0.0;
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

/// Where a camera was, and when: the text files of the TUM RGB-D data sets. A pose is a line
/// `timestamp tx ty tz qx qy qz qw`, time stamps rising. Commas count as blanks; # begins a
/// comment.
class Trajectory {
 public:
  /// The error names file and line, and what was expected there.
  [[nodiscard]] static Expected<Trajectory> read(const std::filesystem::path& path);
  /// `name` stands for the file in errors.
  [[nodiscard]] static Expected<Trajectory> parse(std::string_view text, const std::string& name);

  [[nodiscard]] const std::vector<TimedPose>& poses() const { return poses_; }
  /// The pose at that time, between its neighbours: position linear, rotation along the shortest
  /// arc. Nothing before the first pose, after the last one, and where the neighbours are more than
  /// `max_gap_s` apart.
  [[nodiscard]] std::optional<Pose> at(double time_s, double max_gap_s) const;

 private:
  std::vector<TimedPose> poses_;
};

}  // namespace canopeer
