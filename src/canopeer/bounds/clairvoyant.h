#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/base/expected.h"
#include "canopeer/bounds/motion_verdicts.h"
#include "canopeer/bounds/view_pool.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/planner/playback/plan_file.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer {

/// Work of one view besides a detection and an update of the fruit map: what perception did in the
/// mean over the views of a run (RunRecord::work over its views). The defaults are those of
/// dense_1, 10 s a segment, seed 1, 640 × 480 pixels; the mission's cost table makes seconds of
/// them.
struct ViewWork {
  std::int64_t fuse_points = 160000;
  std::int64_t field_blocks = 4700;
  std::int64_t target_blocks = 2100;
};
/// What a view costs of the mission's clock, s.
[[nodiscard]] double view_cost_s(const ViewWork& work, const CostTable& costs);

/// What the best plan is best at, and how hard it is looked for. Limits are counts.
struct ClairvoyantOptions {
  enum class Objective {
    found,  ///< fruits found at the end; of equal ones the earlier
    auc     ///< mean of fruits found over the mission's time
  };
  Objective objective = Objective::auc;
  ViewWork view_work;
  double latency_s = 0.0;       ///< of the camera: a view takes so much longer
  int views_per_segment = 500;  ///< of the pool's, the undominated and best
  int beam_width = 100;         ///< partial tours in each slice of a segment's time
  int beam_slices = 40;
  int most_views = 40;  ///< of a segment, where neither time nor the protocol limits them
  int rounds = 2;       ///< each segment is planned anew so often, given the others
  std::int64_t max_trials = 400000;  ///< tours reckoned in each local search
  /// By FruitTruth::id: so many times the rule's area is wanted of a fruit (but no more than can be
  /// seen); empty: once.
  std::vector<double> area_factors{};
  /// The way home is longer than the straight one by this factor; the mission plans it.
  double way_home_factor = 1.1;
};

/// A plan, and what it should come to.
struct ClairvoyantPlan {
  ViewPlan plan;                                ///< for the planner `playback`
  std::vector<std::vector<std::size_t>> views;  ///< the same as indices into the pool's segments
  std::vector<std::vector<double>> times_s;     ///< of each view, that at home first; mission time
  int fruits = 0;                               ///< found at the end, by the rule
  std::vector<int> fruit_ids;                   ///< which: FruitTruth::id
  double auc = 0.0;    ///< mean of found / fruits_total over the mission's time
  double end_s = 0.0;  ///< mission time
  std::int64_t motions_judged = 0;
  std::int64_t motions_blocked = 0;
};

/// The best plan found for somebody who knows which patches each view of the pool shows: in each
/// segment views in an order whose straight motions are free in the true world, within the
/// mission's time or number of views, with the clock of the mission: home with a frame when the
/// segment begins, then motion and perception in turn. A motion that was set out for in time is
/// finished, and its frame counts, as SegmentRunner has it, unless the mission is over.
/// Coverage orienteering by greedy choice, beam search and local search
/// (tours/tour_search.h). Frames on the way are not reckoned with; executed, they add to it.
///
/// `verdicts` are those of earlier plans of the same pool, world and mission; they change the time
/// that planning takes, not the plan. The error: pool, mission and robot do not fit each other. The
/// same arguments give the same plan.
[[nodiscard]] Expected<ClairvoyantPlan> plan_clairvoyant(
    const ViewPool& pool, const RobotModel& robot, const MotionJudge& judge,
    const MissionOptions& mission, const FindRule& rule, const ClairvoyantOptions& options,
    MotionVerdicts* verdicts = nullptr);

/// Leaves out the second half of a segment's views, or of the last segment before it that has any.
/// Returns that segment; nothing when there is none. For a run that found no way home from there:
/// what the camera's noise puts into its map is not in the scene, so no plan reckons with it.
std::optional<std::size_t> shorten(ViewPlan& plan, std::size_t segment);

}  // namespace canopeer
