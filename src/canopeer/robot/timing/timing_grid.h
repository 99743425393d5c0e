#pragma once

#include <limits>
#include <vector>

#include "canopeer/robot/joint_limits.h"
#include "canopeer/robot/timing/blended_path.h"
#include "canopeer/robot/timing/image_motion.h"

namespace canopeer {

/// What limits one interval of a path.
struct TimingInterval {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double length = 0.0;
  int piece = 0;
  bool stops = false;    // at its end
  bool line = false;     // straight
  double max_x = kNone;  // ṡ² by the limits of velocity and of image motion
  double max_u = kNone;  // s̈ by the acceleration limits, on a line
  int first_plane = 0;   // on an arc; in the list of all
  int last_plane = 0;
};

/// A path cut into intervals, with limits that hold all over each of them: decision 43, and for
/// image motion 105.
class TimingGrid {
 public:
  struct Fineness {
    double arc_step_rad = 0.05;
    double image_step = 0.03;
  };
  /// `image` may be null: no limit.
  TimingGrid(const BlendedPath& path, const JointLimits& limits, const ImageMotion* image,
             const Fineness& fineness);

  [[nodiscard]] const std::vector<TimingInterval>& intervals() const { return intervals_; }

  /// The accelerations allowed from ṡ² = x when the interval must end with ṡ² in [0, next_x].
  struct Span {
    double low = -TimingInterval::kNone;
    double high = TimingInterval::kNone;
    double low_slope = 0.0;  // how the bounds change with x
    double high_slope = 0.0;
  };
  [[nodiscard]] Span span(const TimingInterval& interval, double x, double next_x) const;
  /// The largest ṡ² at the interval's start from which it can end at next_x or below.
  [[nodiscard]] double controllable(const TimingInterval& interval, double next_x) const;

 private:
  /// slope_u · u + slope_x · x ≤ limit, with x = ṡ² at the interval's start and u = s̈ in it.
  struct HalfPlane {
    double slope_u = 0.0;
    double slope_x = 0.0;
    double limit = 0.0;
  };
  /// A piece, and how fast the image moves there, as far as that is limited.
  struct Limited {
    const BlendedPath::Piece& piece;
    int index = 0;
    const JointLimits& limits;
    const ImageMotion* image = nullptr;
    double image_step = 0.0;
    double bend = 0.0;

    [[nodiscard]] double along(double from_begin) const;
  };
  static void tighten(Span& span, const HalfPlane& plane, double x);
  [[nodiscard]] TimingInterval by_joints(const Limited& part, double from, double length);
  void cut(const Limited& part, double from, double length, double along_begin, double along_end);
  static void limit_on_line(const Limited& part, TimingInterval& interval);
  void limit_on_arc(const Limited& part, double from, TimingInterval& interval);

  std::vector<TimingInterval> intervals_;
  std::vector<HalfPlane> planes_;
};

}  // namespace canopeer
