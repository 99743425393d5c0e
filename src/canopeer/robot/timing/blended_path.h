#pragma once

#include <vector>

#include "canopeer/robot/joint_path.h"

namespace canopeer {

/// A path through waypoints in joint space, parameterised by its length. It has straight lines, and
/// at the waypoints in between circular arcs. An arc touches both lines and passes the waypoint at
/// no more than a given Euclidean distance (Kunz & Stilman, "Time-Optimal Trajectory Generation for
/// Path Following with Bounded Acceleration and Velocity", RSS 2012, section IV). Where no arc fits
/// (no deviation allowed, or the path turns back on itself) it keeps the corner: a motion must stop
/// there.
class BlendedPath {
 public:
  /// A line (start + s·direction) or an arc (centre + r·(x cos(s/r) + y sin(s/r))).
  struct Piece {
    double begin = 0.0;    ///< path length at its start
    double length = 0.0;   ///< > 0
    double radius = 0.0;   ///< 0: a line
    Configuration origin;  ///< line: start; arc: centre
    Configuration x;       ///< line: unit direction; arc: unit vector from the centre to the start
    Configuration y;       ///< arc: unit direction at the start
    bool stops = false;    ///< the piece ends in a corner, or the path ends with it
  };

  /// At least one waypoint, all of one size; repeated ones count once. Deviations ≥ 0.
  explicit BlendedPath(const JointPath& path);
  /// The same deviation at every waypoint.
  BlendedPath(const std::vector<Configuration>& waypoints, double max_deviation);

  /// 0 when all waypoints are one.
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const Configuration& start() const { return start_; }

  /// Index of the piece at path length `s`, 0 ≤ s ≤ length(); there must be one.
  [[nodiscard]] int piece_at(double s) const;
  /// Point, first and second derivative by path length, on a piece.
  static Configuration point(const Piece& piece, double s);
  static Configuration tangent(const Piece& piece, double s);
  static Configuration curvature(const Piece& piece, double s);

 private:
  void add_line(const Configuration& from, const Configuration& to, bool stops);

  Configuration start_;
  std::vector<Piece> pieces_;
  double length_ = 0.0;
};

}  // namespace canopeer
