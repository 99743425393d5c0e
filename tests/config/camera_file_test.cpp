#include "canopeer/config/camera_file.h"

#include <gtest/gtest.h>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

Expected<CameraFile> camera(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) / "canopeer_camera.yaml";
  EXPECT_TRUE(write_file(path, text));
  return load_camera(path);
}

TEST(CameraFile, SaysWhatIsNoDepth) {
  const std::string lens = "fx_px: 70\nfy_px: 71\ncx_px: 39.5\ncy_px: 29.5\n";
  const auto plain = camera(lens);
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(plain->depth.per_m, 5000.0);
  EXPECT_EQ(plain->depth.max_depth_m, 0.0);
  EXPECT_FALSE(plain->y_up);
  const auto limited = camera(lens + "depth_units_per_m: 1000\nmax_depth_m: 10\n");
  ASSERT_TRUE(limited) << limited.error().message;
  EXPECT_EQ(limited->depth.per_m, 1000.0);
  EXPECT_EQ(limited->depth.max_depth_m, 10.0);
}

TEST(CameraFile, ANegativeFocalLengthMeansThatYPointsUp) {
  const auto file = camera("fx_px: 481.2\nfy_px: -480\ncx_px: 319.5\ncy_px: 239.5\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(file->y_up);
  EXPECT_EQ(file->intrinsics.fy, 480.0);
  EXPECT_FALSE(camera("fx_px: 481\nfy_px: 0\ncx_px: 319.5\ncy_px: 239.5\n"));
  EXPECT_FALSE(camera("fx_px: -481\nfy_px: 480\ncx_px: 319.5\ncy_px: 239.5\n"));
}

}  // namespace
}  // namespace canopeer
