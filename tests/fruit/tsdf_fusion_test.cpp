#include "canopeer/fruit/surface/tsdf_fusion.h"

#include <gtest/gtest.h>

#include "../detect/synthetic_view.h"

namespace canopeer {
namespace {

using namespace synthetic;

TEST(TsdfFusion, GivesTheSameBitsWithNarrowRegisters) {
  const Vec3 centre(0.6, 0.0, 0.6);
  const TsdfOptions options;
  FruitTsdf::Block wide;
  FruitTsdf::Block narrow;
  int seen = 0;
  for (const double y : {-0.2, -0.05, 0.1}) {
    const View view =
        look({ball(centre, 0.035, kRipe, true)}, Vec3(0.05, y, 0.55 + 0.3 * y), centre);
    Mask classes = view.fruit;
    for (auto& c : classes.pixels()) c = c != 0 ? 3 : 0;
    FrameDepths depths;
    depths.set(view.frame.depth, static_cast<float>(options.max_range_m),
               static_cast<float>(options.max_depth_step_m));
    // The block that holds the nearest point of the ball.
    const VoxelIndex index = voxel_at(centre - Vec3(0.035, 0, 0), 8 * options.voxel_m);
    wide.index = narrow.index = index;
    TsdfFusion(view.frame, classes, depths, options, best_simd_level()).fuse(wide);
    TsdfFusion(view.frame, classes, depths, options, SimdLevel::scalar).fuse(narrow);
    EXPECT_EQ(wide.distance_m, narrow.distance_m);
    EXPECT_EQ(wide.weight, narrow.weight);
    EXPECT_EQ(wide.seen, narrow.seen);
    EXPECT_EQ(wide.inside, narrow.inside);
    EXPECT_EQ(wide.changed, narrow.changed);
    for (std::size_t i = 0; i < wide.looks.size(); ++i) {
      EXPECT_EQ(wide.looks[i].votes, narrow.looks[i].votes);
      EXPECT_EQ(wide.looks[i].color, narrow.looks[i].color);
      seen += wide.looks[i].votes[3] > 0.0F;
    }
  }
  EXPECT_GT(seen, 100);
}

}  // namespace
}  // namespace canopeer
