#pragma once

#include <string>
#include <vector>

#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/sphere_cover.h"
#include "canopeer/robot/view_ik.h"

namespace canopeer {

/// How often two links' true shapes touch among random states of arm and trolley.
struct LinkPairSurvey {
  std::string link_a;
  std::string link_b;
  bool adjacent = false;  ///< joined by one joint: of course they touch
  bool disabled = false;  ///< the SRDF says they need no check
  int touching = 0;       ///< of the states looked at
  int states = 0;
  /// Not disabled, and near contact in all of some states by the convex solids of fast checks: no
  /// state of the arm is free then. Hollows of meshes are filled up in them.
  bool solids_always_touch = false;

  [[nodiscard]] bool always() const { return touching == states; }
  [[nodiscard]] bool never() const { return touching == 0; }
  /// "Adjacent", "Always" or "Never"; null: it should be checked.
  [[nodiscard]] const char* reason_to_disable() const;
};

/// All pairs of links with shapes that something moves against each other, in the order of
/// RobotModel::links(). FCL judges `states` random states; the same seed gives the same answer.
[[nodiscard]] std::vector<LinkPairSurvey> survey_link_pairs(const RobotModel& robot, int states,
                                                            std::uint64_t seed);

/// An SRDF that disables the pairs that are adjacent, always touch or never do, with the reason.
[[nodiscard]] std::string srdf_of(const std::string& robot_name,
                                  const std::vector<LinkPairSurvey>& pairs);

/// Views of a side: a camera position in the workspace and a target in the sampling region 0.3 to
/// 0.6 m from it.
struct ReachSurvey {
  int views = 0;
  int reached = 0;  ///< the arm can look so
  int free = 0;     ///< and touches neither itself nor the trolley
  /// The workspace cut in 3 × 3 × 3 parts (x fastest): views there, and how many are free.
  std::vector<int> part_views = std::vector<int>(27, 0);
  std::vector<int> part_free = std::vector<int>(27, 0);
};

[[nodiscard]] ReachSurvey survey_reach(const RobotModel& robot, const ArmIk& ik, int side,
                                       int views, std::uint64_t seed);

/// Box around all links that move with the arm, base frame.
[[nodiscard]] Box arm_bounds(const RobotModel& robot, const Configuration& q);

/// A link of the arm and the spheres that stand for it.
struct CoverSurvey {
  std::string link;
  int spheres = 0;
  CoverQuality quality;
};

[[nodiscard]] std::vector<CoverSurvey> survey_covers(const RobotModel& robot,
                                                     double sphere_excess_m);

}  // namespace canopeer
