#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/bounds/visibility/fruit_cutting.h"
#include "canopeer/bounds/visibility/pool_checkpoint.h"
#include "canopeer/bounds/visibility/view_sampling.h"
#include "canopeer/render/numbered_view.h"
#include "canopeer/render/sight_lines.h"

namespace canopeer {

/// What views are sampled of. All outlive the sampler.
struct SampledWorld {
  const RobotModel& robot;
  const ArmIk& ik;
  const Scene& scene;
  const MotionJudge& judge;
};

/// Of these patches those that one view or none has shown.
[[nodiscard]] std::vector<std::uint32_t> rarely_seen(const std::vector<std::uint32_t>& patches,
                                                     const std::vector<std::uint32_t>& times_seen);

/// Of how many fruits a patch or more was seen.
[[nodiscard]] int fruits_seen(const FruitPatches& patches,
                              const std::vector<std::uint32_t>& times_seen);

/// Samples the views of one segment, in parallel; sample number n draws from a stream of its own,
/// so the result depends on numbers only.
class SegmentSampler {
 public:
  SegmentSampler(const SampledWorld& world, const SegmentFrame& frame, const CutFruits& fruits,
                 const CameraIntrinsics& camera, std::uint64_t seed);

  /// The first view, whether or not it shows anything.
  void look_from_home(PoolState& state) const;
  /// The next `count` samples, and from the second time on one aimed at each patch that no view or
  /// only one of this segment has shown. Those that find no free configuration are left out; so are
  /// views that show nothing.
  void sample(int count, PoolState& state) const;
  /// Aims at each of these patches that may be in range, 32 times or less: `tries` times in all,
  /// about, and once in any case. `round` tells streams apart.
  void aim_again(const std::vector<std::uint32_t>& patches, std::int64_t tries, int round,
                 PoolState& state) const;
  /// So many until each fruit in range has been aimed at `aimed` times.
  [[nodiscard]] int least_samples(int aimed) const;

 private:
  SegmentSampler(const SampledWorld& world, const SegmentFrame& frame, const CutFruits& fruits,
                 const CameraIntrinsics& camera, std::uint64_t seed,
                 const std::vector<NumberedPart>& near);
  [[nodiscard]] std::optional<Configuration> draw(std::uint64_t number) const;
  /// Aimed at a point of a patch.
  [[nodiscard]] std::optional<Configuration> draw_at(std::uint32_t patch,
                                                     const std::string& stream) const;
  void take_in(std::vector<std::optional<PoolView>> found, PoolState& state) const;
  [[nodiscard]] PoolView look(const Configuration& q) const;

  const SampledWorld world_;
  SegmentFrame frame_;
  CameraIntrinsics camera_;
  std::uint64_t seed_;
  FreeViews free_;
  NumberedView picture_;
  SightLines sights_;
  const std::vector<std::vector<Vec3>>& points_;  // by patch
  std::vector<std::uint32_t> patches_near_;       // those that may be in range
};

}  // namespace canopeer
