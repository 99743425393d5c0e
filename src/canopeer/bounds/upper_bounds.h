#pragma once

#include "canopeer/bounds/view_pool.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/record/yardstick.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// How much work goes into the bounds. All are counts: more work makes a bound tighter, less never
/// makes it wrong.
struct BoundOptions {
  int columns = 500;  ///< of the linear programs, a segment; ways to reach a view that are left
                      ///< are merged so that no plan is lost
  int times = 4;      ///< linear programs a segment, by time
  int iterations = 50000;  ///< of the simplex method, a program
  int cells = 400;  ///< of the certified bound: boxes of joint angles looked at, a fruit and stop
  /// With the paper's clock T is no part of the mission: transitions may take any time. Who gives a
  /// T gets a bound on AUC for runs that end by then. 0: for all runs, which is that of fruits. The
  /// whole clock has its own T.
  double end_s = 0.0;
};

/// What no planner can surpass whose views are among those of the pool: of fruits by time, at the
/// end, and of AUC (mean of B(t) / N). At each time the least of
/// - `ceiling`: fruits of which so much has been in reach by then, from standing at home
/// (FindRule);
/// - `linear program`: views bought with time, each at least at the price of the way to it;
/// - `marginals`: what a greedy plan finds, and the fractional knapsack of what each view adds to
/// it
///   (Leskovec et al., "Cost-effective outbreak detection in networks", KDD 2007).
///
/// It holds for planners that stay at the segments' stops, and between two views a planner may
/// stand wherever it likes. A fruit counts as found no sooner than `rule` says; what the fruit map
/// needs to report one is more. With frames on the way it holds for frames taken while the trolley
/// stands, and motions are only bounded by the joints' speeds. Motion times are lower bounds for
/// any path (limits/motion_bound.h), perception costs what the mission's table says at least.
///
/// The pool has the mission's segments. The same input gives the same bound, on one thread.
[[nodiscard]] UpperBound sampled_bound(const ViewPool& pool, const RobotModel& robot,
                                       const MissionOptions& mission, const FindRule& rule,
                                       const BoundOptions& options = {});

/// The same over all views there are: fruits that can have been in front of the camera by t, as if
/// nothing stood before them. How soon is bounded by the joints' limits and the camera's frustum
/// and range, over boxes of joint angles that cover all (limits/first_sight.h, decision 115). Holds
/// with frames on the way too, while the trolley drives from stop to stop as well. It takes the
/// camera as it is described (no error of lens or mounting) and the fruit as found only once a part
/// of it was in the picture: an estimate that stands there by mistake is not thought of.
[[nodiscard]] UpperBound certified_bound(const Scene& scene, const RobotModel& robot,
                                         const MissionOptions& mission,
                                         const CameraIntrinsics& camera,
                                         const BoundOptions& options = {});

}  // namespace canopeer
