#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/render/renderer.h"
#include "canopeer/scene/scene_file.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

/// A frozen scene shows what it showed: the same images after any number of writes and reads, and
/// those of the plants it was made of but for the grid.
TEST(FrozenScene, ShowsTheSameImages) {
  WorldOptions options;
  options.name = "row";
  add_row({0.75, 0.0, 0.5, 2, 0.0, PlantPreset::numbered, {5, 7}}, &options);
  const Scene grown = make_world(options, 3);
  const auto frozen = parse_scene(*scene_bytes(grown));
  ASSERT_TRUE(frozen.has_value());
  const auto again = parse_scene(*scene_bytes(*frozen));
  ASSERT_TRUE(again.has_value());
  const CameraIntrinsics camera = CameraIntrinsics::from_fov(160, 120, 1.2);
  const Pose T_world_camera = look_at(Vec3(0.0, 0.25, 0.5), Vec3(0.75, 0.25, 0.4));
  const RenderedView before = Renderer(grown).render(camera, T_world_camera);
  const RenderedView first = Renderer(*frozen).render(camera, T_world_camera);
  const RenderedView second = Renderer(*again).render(camera, T_world_camera);
  EXPECT_EQ(first.color.pixels(), second.color.pixels());
  EXPECT_EQ(first.depth.pixels(), second.depth.pixels());
  EXPECT_EQ(first.labels.fruit.pixels(), second.labels.fruit.pixels());
  int other_label = 0;
  int other_depth = 0;
  for (std::size_t i = 0; i < first.depth.pixels().size(); ++i) {
    other_label += before.labels.fruit.pixels()[i] != first.labels.fruit.pixels()[i];
    other_depth += std::abs(before.depth.pixels()[i] - first.depth.pixels()[i]) > 1e-3F;
  }
  // Outlines move by less than a tenth of a pixel; only pixels on one can change.
  EXPECT_LT(other_label, 0.005 * 160 * 120);
  EXPECT_LT(other_depth, 0.05 * 160 * 120);
}

}  // namespace
}  // namespace canopeer
