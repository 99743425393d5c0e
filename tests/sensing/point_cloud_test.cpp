#include "canopeer/sensing/point_cloud.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

std::filesystem::path temporary(const char* name) {
  return std::filesystem::path(::testing::TempDir()) / name;
}

TEST(PointCloud, IsWrittenAsBinaryPlyWithNormalsAndColours) {
  PointCloud cloud;
  cloud.points = {{1.5F, -2.0F, 0.25F}, {4.0F, 5.0F, 6.0F}};
  cloud.normals = {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
  cloud.colors = {{204, 41, 9}, {1, 2, 3}};
  const std::filesystem::path path = temporary("canopeer_cloud.ply");
  ASSERT_TRUE(write_ply(path, cloud).has_value());
  const Expected<std::string> bytes = read_file(path);
  ASSERT_TRUE(bytes.has_value());
  EXPECT_EQ(bytes->rfind("ply\nformat binary_little_endian 1.0\n", 0), 0U);
  EXPECT_NE(bytes->find("element vertex 2\n"), std::string::npos);
  const std::string end = "end_header\n";
  const std::size_t data = bytes->find(end) + end.size();
  ASSERT_EQ(bytes->size() - data, 2U * 27U);
  float second_y = 0.0F;
  std::memcpy(&second_y, bytes->data() + data + 27 + 4, sizeof second_y);
  EXPECT_EQ(second_y, 5.0F);
  EXPECT_EQ(static_cast<unsigned char>((*bytes)[data + 24]), 204);
  std::filesystem::remove(path);
}

TEST(PointCloud, WithoutPointsIsAValidFile) {
  const std::filesystem::path path = temporary("canopeer_empty.ply");
  ASSERT_TRUE(write_ply(path, {}).has_value());
  EXPECT_NE(read_file(path)->find("element vertex 0\n"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(PointCloud, IntoAMissingFolderFailsWithTheFileName) {
  const Expected<void> written = write_ply("/nonexistent/canopeer/cloud.ply", {});
  ASSERT_FALSE(written.has_value());
  EXPECT_NE(written.error().message.find("cloud.ply"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
