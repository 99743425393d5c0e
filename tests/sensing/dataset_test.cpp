// Recorded data sets: which images and clouds there are, and their poses.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/sensing/cloud_folder.h"
#include "canopeer/sensing/png.h"
#include "canopeer/sensing/tum_sequence.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

class Dataset : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::path(testing::TempDir()) /
                 (std::string("canopeer_dataset_") +
                  testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory_);
    fs::create_directories(directory_ / "depth");
    fs::create_directories(directory_ / "rgb");
  }
  void TearDown() override { fs::remove_all(directory_); }

  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(write_file(directory_ / name, text));
  }
  [[nodiscard]] std::string tum_error(const TumOptions& options = {}) const {
    const auto sequence = open_tum_sequence(directory_, options);
    return sequence ? "no error" : sequence.error().message;
  }
  [[nodiscard]] std::string folder_error() const {
    const auto folder = open_cloud_folder(directory_);
    return folder ? "no error" : folder.error().message;
  }
  fs::path directory_;
};

void expect_in(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), std::string::npos) << "\"" << part << "\" in: " << whole;
}

TEST_F(Dataset, TumFramesGetTheNearestColourAndAPoseInBetween) {
  for (const char* name : {"depth/1.png", "depth/2.png", "depth/3.png", "rgb/a.png", "rgb/b.png"}) {
    write(name, "");
  }
  write("depth.txt", "# depth maps\n1.00 depth/1.png\n2.00 depth/2.png\n3.00 depth/3.png\n");
  write("rgb.txt", "0.99 rgb/a.png\n1.015 rgb/b.png\n2.5 rgb/b.png\n");
  write("groundtruth.txt",
        "0.9 0 0 0 0 0 0 1\n1.1 2 0 0 0 0 0 1\n2.9 3 0 0 0 0 0 1\n3.1 3 0 0 0 0 0 1\n");
  EXPECT_TRUE(is_tum_sequence(directory_));
  const auto sequence = open_tum_sequence(directory_);
  ASSERT_TRUE(sequence) << sequence.error().message;
  ASSERT_EQ(sequence->frames.size(), 2U);
  EXPECT_EQ(sequence->frames[0].depth, directory_ / "depth/1.png");
  EXPECT_EQ(sequence->frames[0].color, directory_ / "rgb/a.png");
  EXPECT_NEAR(sequence->frames[0].T_world_camera.translation().x(), 1.0, 1e-9);
  EXPECT_TRUE(sequence->frames[1].color.empty());
  EXPECT_EQ(sequence->without_color, 1);
  EXPECT_EQ(sequence->gaps.observations, 1);
  EXPECT_EQ(sequence->gaps.first_s, 2.0);
}

TEST_F(Dataset, AssociationsMayNameColourOrDepthFirst) {
  for (const char* name : {"depth/1.png", "rgb/a.png"}) write(name, "");
  write("groundtruth.txt", "0 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  TumOptions options;
  options.max_pose_gap_s = 5.0;
  for (const char* line : {"1.0 depth/1.png 1.1 rgb/a.png\n", "1.1 rgb/a.png 1.0 depth/1.png\n"}) {
    write("associations.txt", line);
    const auto sequence = open_tum_sequence(directory_, options);
    ASSERT_TRUE(sequence) << sequence.error().message;
    EXPECT_EQ(sequence->frames.at(0).time_s, 1.0);
    EXPECT_EQ(sequence->frames.at(0).depth, directory_ / "depth/1.png");
    EXPECT_EQ(sequence->frames.at(0).color, directory_ / "rgb/a.png");
  }
  write("associations.txt", "1.0 depth/1.png 1.1\n");
  expect_in("associations.txt:1: expected", tum_error());
}

TEST_F(Dataset, TumErrorsNameFileAndLine) {
  write("depth/1.png", "");
  write("depth.txt", "1.0 depth/1.png\n");
  expect_in("groundtruth.txt", tum_error());
  write("groundtruth.txt", "0 0 0 0 0 0 0\n");
  expect_in("groundtruth.txt:1: expected the 8 numbers", tum_error());
  write("groundtruth.txt", "5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n");
  expect_in("no depth image has a pose", tum_error());
  write("depth.txt", "# depth\n1.0 depth/1.png\nsoon depth/1.png\n");
  expect_in("depth.txt:3: expected a time stamp", tum_error());
  write("depth.txt", "1.0\n");
  expect_in("depth.txt:1: expected `timestamp file`", tum_error());
  write("depth.txt", "1.0 depth/9.png\n");
  expect_in("depth.txt:1: the image", tum_error());
  write("depth.txt", "# none\n");
  expect_in("no depth images", tum_error());
}

TEST_F(Dataset, CloudsAreMatchedByTimeStampOrByOrder) {
  for (const char* name : {"1.5.ply", "2.5.ply"}) {
    ASSERT_TRUE(write_ply(directory_ / name, {{Eigen::Vector3f(1, 2, 3)}, {}, {}}));
  }
  write("poses.txt", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n");
  CloudFolderOptions options;
  options.max_pose_gap_s = 1.0;
  auto folder = open_cloud_folder(directory_, options);
  ASSERT_TRUE(folder) << folder.error().message;
  EXPECT_NEAR(folder->frames.at(1).T_world_points->translation().x(), 1.5, 1e-12);
  EXPECT_TRUE(load_cloud(*folder, 0));

  write("poses.txt", "100 7 0 0 0 0 0 1\n200 8 0 0 0 0 0 1\n");
  folder = open_cloud_folder(directory_);
  ASSERT_TRUE(folder) << folder.error().message;
  EXPECT_EQ(folder->frames.at(1).T_world_points->translation().x(), 8.0);
  write("poses.txt", "100 7 0 0 0 0 0 1\n");
  expect_in("1 poses for 2 clouds", folder_error());
}

TEST_F(Dataset, CloudsWithoutATrajectoryMustSayTheirPosesThemselves) {
  expect_in("no .ply or .pcd", folder_error());
  const std::string header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\n";
  write("a.pcd", header + "VIEWPOINT 1 0 0 1 0 0 0\nDATA ascii\n1 2 3\n");
  write("b.pcd", header + "DATA ascii\n1 2 3\n");
  const auto folder = open_cloud_folder(directory_);
  ASSERT_TRUE(folder);
  const auto a = load_cloud(*folder, 0);
  ASSERT_TRUE(a) << a.error().message;
  EXPECT_EQ(a->T_world_points.translation().x(), 1.0);
  const auto b = load_cloud(*folder, 1);
  ASSERT_FALSE(b);
  expect_in("b.pcd: nobody says where", b.error().message);
}

TEST_F(Dataset, DepthImagesAreReadInTheUnitTheyHave) {
  DepthImage depth(3, 2, 1.5F);
  depth.at(1, 1) = 0.0F;
  const fs::path path = directory_ / "depth/1.png";
  ASSERT_TRUE(write_depth_png(path, depth, 5000.0));
  const auto read = read_depth_png(path, 5000.0);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->width(), 3);
  EXPECT_EQ(read->pixels(), depth.pixels());
  EXPECT_NEAR(read_depth_png(path, 1000.0)->at(0, 0), 7.5F, 1e-5F);
  ASSERT_TRUE(write_png(path, ColorImage(3, 2)));
  expect_in("expected 16 bit grey, got 8 bit colour", read_depth_png(path, 5000.0).error().message);
}

TEST_F(Dataset, APngThatClaimsToBeHugeTakesNoMemory) {
  const fs::path path = directory_ / "depth/1.png";
  ASSERT_TRUE(write_depth_png(path, DepthImage(3, 2, 1.0F), 5000.0));
  std::string bytes = *read_file(path);
  for (const std::size_t at : {17U, 21U}) bytes[at] = '\x0F';  // 983 043 × 983 042 pixels
  expect_in("more than a file of", parse_depth_png(bytes, 5000.0).error().message);
  expect_in("more than a file of", parse_png(bytes).error().message);
}

TEST_F(Dataset, PngReadersSurviveDamagedFiles) {
  const fs::path path = directory_ / "depth/1.png";
  ASSERT_TRUE(write_depth_png(path, DepthImage(16, 9, 1.0F), 5000.0));
  const std::string bytes = *read_file(path);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    (void)parse_png(bytes.substr(0, size));
    EXPECT_FALSE(parse_depth_png(bytes.substr(0, size), 5000.0) && size + 12 < bytes.size());
    std::string damaged = bytes;
    for (const char value : {'\0', '\xFF', '\x01'}) {
      damaged[size] = value;
      (void)parse_png(damaged);
      (void)parse_depth_png(damaged, 5000.0);
    }
  }
}

}  // namespace
}  // namespace canopeer
