#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/trajectory.h"

namespace canopeer {

using Words = std::vector<std::string_view>;

/// Which numbers of a line are what of a pose.
struct PoseLayout {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::size_t words = 0;           ///< of each line
  std::size_t time = kNone;        ///< kNone: no time stamps
  double time_unit_s = 0.0;        ///< 0: seconds, or what the size of the stamps says
  std::size_t matrix = kNone;      ///< first of 12 numbers: the upper three rows, row by row
  std::array<std::size_t, 3> t{};  ///< x y z; unused with a matrix
  std::array<std::size_t, 4> q{};  ///< x y z w; unused with a matrix
  bool from_head = false;          ///< a line of the file names the columns
  std::string taken;               ///< what was taken for what, for people

  /// The order of the quaternion is known: names say it, or there is none.
  [[nodiscard]] bool order_is_said() const { return from_head || matrix != kNone; }
};

/// From the names of columns, as EuRoC, ROS and spreadsheets have them ("q_RS_w []", "tx",
/// "pose.orientation.x"). Nothing when they do not name a position and a quaternion.
[[nodiscard]] std::optional<PoseLayout> layout_of_head(const Words& names);

/// From how many numbers a line has: 8 TUM, 7 the same without time stamps, 12 KITTI, 13 with a
/// time stamp before it, 16 a whole matrix. Nothing for other numbers.
[[nodiscard]] std::optional<PoseLayout> layout_of_width(std::size_t words);

/// The names in a head: between commas or semicolons, else between blanks, each with its unit.
[[nodiscard]] Words names_in(std::string_view line);

/// The pose that a line holds.
[[nodiscard]] Expected<TimedPose> pose_of(const Words& words, const PoseLayout& layout);

/// The pose of a matrix's upper three rows, row by row.
[[nodiscard]] Expected<Pose> pose_of_matrix(const std::array<double, 12>& m);

/// A time stamp in seconds. Whole milli-, micro- and nanoseconds since 1970 are told by their size.
[[nodiscard]] double seconds_of_stamp(double stamp);

}  // namespace canopeer
