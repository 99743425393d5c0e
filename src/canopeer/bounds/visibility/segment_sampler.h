#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/bounds/visibility/fruit_cutting.h"
#include "canopeer/bounds/visibility/pool_checkpoint.h"
#include "canopeer/bounds/visibility/view_sampling.h"
#include "canopeer/render/numbered_view.h"

namespace canopeer {

/// What views are sampled of. All outlive the sampler.
struct SampledWorld {
  const RobotModel& robot;
  const ArmIk& ik;
  const Scene& scene;
  const MotionJudge& judge;
};

/// Samples the views of one segment, in parallel; sample number n draws from a stream of its own,
/// so the result depends on numbers only.
class SegmentSampler {
 public:
  SegmentSampler(const SampledWorld& world, const SegmentFrame& frame, const CutFruits& fruits,
                 const CameraIntrinsics& camera, std::uint64_t seed);

  /// The first view, whether or not it shows anything.
  void look_from_home(PoolState& state) const;
  /// The next `count` samples. Those that find no free configuration are left out; so are views
  /// that show nothing.
  void sample(int count, PoolState& state) const;
  /// So many until each fruit in range has been aimed at `aimed` times.
  [[nodiscard]] int least_samples(int aimed) const;

 private:
  [[nodiscard]] std::optional<Configuration> draw(std::uint64_t number) const;
  [[nodiscard]] PoolView look(const Configuration& q) const;

  const SampledWorld world_;
  SegmentFrame frame_;
  CameraIntrinsics camera_;
  std::uint64_t seed_;
  FreeViews free_;
  NumberedView picture_;
};

}  // namespace canopeer
