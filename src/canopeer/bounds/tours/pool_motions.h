#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/bounds/motion_verdicts.h"
#include "canopeer/bounds/tours/tour_views.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer {

/// Motions between views of a pool: timed as the graph's edges are (straight_motion_time()), free
/// when the judge says that they touch neither the robot itself nor the structure nor a plant.
/// Times and verdicts are kept. A motion that is not free has its time until somebody asks: what
/// others asked before changes nothing but the time that it takes. Not thread-safe.
///
/// The way home is planned by the mission on its map, which nobody knows here: it counts as the
/// straight way, longer by a part.
class PoolMotions : public TourMotions {
 public:
  /// All outlive it.
  PoolMotions(const ViewPool& pool, const TourViews& views, const RobotModel& robot,
              const MotionJudge& judge, const MissionOptions& mission, double way_home_factor,
              MotionVerdicts& verdicts);

  [[nodiscard]] double time_s(int segment, int from, int to) override;
  [[nodiscard]] bool free(int segment, int from, int to) override;
  [[nodiscard]] double transition_s(int segment, int from) override;

  /// Motions asked about, whether or not others had asked before; and those not free.
  [[nodiscard]] std::int64_t judged() const { return judged_; }
  [[nodiscard]] std::int64_t blocked() const { return blocked_; }

 private:
  struct Edge {
    float time_s = -1.0F;  ///< < 0: not reckoned yet; infinite: not free
    bool judged = false;
  };
  Edge& edge(int segment, int from, int to);
  [[nodiscard]] bool judge(int segment, int from, int to);
  [[nodiscard]] std::size_t in_pool(int segment, int view) const;
  [[nodiscard]] const Configuration& q(int segment, int view) const;

  const ViewPool& pool_;
  const TourViews& views_;
  const RobotModel& robot_;
  const MotionJudge& judge_;
  const MissionOptions& mission_;
  double way_home_factor_;
  MotionVerdicts& verdicts_;
  std::vector<std::vector<Edge>> edges_;  ///< by segment, from · views + to
  std::vector<std::vector<double>> home_s_;
  std::int64_t judged_ = 0;
  std::int64_t blocked_ = 0;
};

}  // namespace canopeer
