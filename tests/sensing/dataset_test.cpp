// Recorded data sets: which images and clouds there are, and their poses.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/sensing/cloud_folder.h"
#include "canopeer/sensing/depth_file.h"
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
  write("groundtruth.txt", "0 0 0 0 0 0\n");
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

TEST_F(Dataset, PosesWithoutTimeStampsGoToTheImagesInOrder) {
  for (const char* name : {"depth/1.png", "depth/2.png"}) write(name, "");
  write("depth.txt", "5.5 depth/1.png\n6.5 depth/2.png\n");
  for (const char* poses :
       {"1 2 3 0 0 0 1\n4 5 6 0 0 0 1\n", "1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 4 0 1 0 5 0 0 1 6\n"}) {
    write("groundtruth.txt", poses);
    const auto sequence = open_tum_sequence(directory_);
    ASSERT_TRUE(sequence) << sequence.error().message;
    EXPECT_EQ(sequence->frames.at(1).T_world_camera.translation(), Vec3(4, 5, 6));
    EXPECT_TRUE(sequence->poses.notices.empty());
  }
  // Counted instead of timed, as some of ICL-NUIM's are.
  write("groundtruth.txt", "1 1 2 3 0 0 0 1\n2 4 5 6 0 0 0 1\n");
  const auto counted = open_tum_sequence(directory_);
  ASSERT_TRUE(counted) << counted.error().message;
  EXPECT_EQ(counted->frames.at(1).T_world_camera.translation(), Vec3(4, 5, 6));
  expect_in("only count the poses", counted->poses.notices.at(0));
  write("groundtruth.txt", "1 2 3 0 0 0 1\n");
  expect_in("has 1 poses without time stamps for 2 depth images", tum_error());
  // Images that are counted as well are found by their numbers.
  write("depth.txt", "0 depth/1.png\n1 depth/2.png\n");
  write("groundtruth.txt", "1 1 2 3 0 0 0 1\n2 4 5 6 0 0 0 1\n");
  const auto numbered = open_tum_sequence(directory_);
  ASSERT_TRUE(numbered) << numbered.error().message;
  ASSERT_EQ(numbered->frames.size(), 1U);
  EXPECT_EQ(numbered->frames[0].depth, directory_ / "depth/2.png");
  EXPECT_EQ(numbered->frames[0].T_world_camera.translation(), Vec3(1, 2, 3));
}

TEST_F(Dataset, ImagesWithoutAListAreTakenInOrder) {
  for (const char* name :
       {"depth/2.pgm", "depth/10.pgm", "depth/1.png", "rgb/10.png", "depth/a.txt"}) {
    write(name, "");
  }
  write("pose.txt", "1 0 0 0 0 0 1\n2 0 0 0 0 0 1\n10 0 0 0 0 0 1\n");
  EXPECT_TRUE(is_tum_sequence(directory_));
  auto sequence = open_tum_sequence(directory_);
  ASSERT_TRUE(sequence) << sequence.error().message;
  ASSERT_EQ(sequence->frames.size(), 3U);
  EXPECT_EQ(sequence->frames[2].depth, directory_ / "depth/10.pgm");
  EXPECT_EQ(sequence->frames[2].T_world_camera.translation().x(), 10.0);
  EXPECT_EQ(sequence->frames[2].color, directory_ / "rgb/10.png");
  EXPECT_TRUE(sequence->frames[0].color.empty());
  // The names are time stamps when the poses have some.
  write("pose.txt", "2 2 0 0 0 0 0 1\n10 10 0 0 0 0 0 1\n");
  sequence = open_tum_sequence(directory_);
  ASSERT_TRUE(sequence) << sequence.error().message;
  EXPECT_EQ(sequence->frames.at(1).T_world_camera.translation().x(), 10.0);
  EXPECT_EQ(sequence->gaps.observations, 1);
}

TEST_F(Dataset, StampsInNanosecondsMeetThoseInSeconds) {
  write("depth/1.png", "");
  write("depth.txt", "\xEF\xBB\xBF#timestamp [ns],filename\n1403636579763555584,depth/1.png\n");
  write("groundtruth.txt", "1403636579.70 0 0 0 0 0 0 1\n1403636579.80 1 0 0 0 0 0 1\n");
  const auto sequence = open_tum_sequence(directory_);
  ASSERT_TRUE(sequence) << sequence.error().message;
  EXPECT_NEAR(sequence->frames.at(0).T_world_camera.translation().x(), 0.6356, 1e-3);
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
  write("poses.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n1 0 0 8 0 1 0 0 0 0 1 0\n");  // KITTI
  folder = open_cloud_folder(directory_);
  ASSERT_TRUE(folder) << folder.error().message;
  EXPECT_EQ(folder->frames.at(1).T_world_points->translation().x(), 8.0);
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

std::string pgm16(const std::vector<int>& values, bool text) {
  std::string bytes = std::string(text ? "P2" : "P5") + "\n# made by hand\n2 2\n65535\n";
  for (const int value : values) {
    if (text) {
      bytes += std::to_string(value) + " ";
    } else {
      bytes.push_back(static_cast<char>(value >> 8));
      bytes.push_back(static_cast<char>(value & 0xFF));
    }
  }
  return bytes;
}

TEST_F(Dataset, WhatMeansNoDepthIsNone) {
  const std::vector<int> units = {0, 65535, 2500, 10000};
  for (const bool text : {false, true}) {
    const auto depth = parse_depth_image(pgm16(units, text), {1000.0, 0.0});
    ASSERT_TRUE(depth) << depth.error().message;
    EXPECT_EQ(depth->pixels(), (std::vector<float>{0.0F, 0.0F, 2.5F, 10.0F}));
    const auto limited = parse_depth_image(pgm16(units, text), {1000.0, 10.0});
    EXPECT_EQ(limited->pixels(), (std::vector<float>{0.0F, 0.0F, 2.5F, 0.0F}));
  }
  DepthImage png(2, 1, 2.5F);
  png.at(1, 0) = 80.0F;  // saturates at 65.535 m
  const fs::path path = directory_ / "depth/1.png";
  ASSERT_TRUE(write_depth_png(path, png, 1000.0));
  EXPECT_EQ(read_depth_image(path, {1000.0, 0.0})->pixels(), (std::vector<float>{2.5F, 0.0F}));
}

TEST_F(Dataset, PgmReadersSurviveDamagedFiles) {
  const auto error = [](const std::string& bytes) {
    const auto depth = parse_depth_image(bytes, {1000.0, 0.0});
    return depth ? "no error" : depth.error().message;
  };
  expect_in("got 8 bit grey", error("P5\n2 1\n255\nab"));
  expect_in("cut off", error("P5\n1048576 1048576\n65535\nab"));
  expect_in("header is damaged", error("P5\n2 -1\n65535\nab"));
  expect_in("pixel 2", error("P2\n2 1\n65535\n7 x"));
  expect_in("got JPEG", error("\xFF\xD8\xFF\xE0"));
  expect_in("not a PNG file", error("hello"));
  for (const bool text : {false, true}) {
    const std::string bytes = pgm16({1, 2, 3, 4}, text);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(parse_depth_image(bytes.substr(0, size), {1000.0, 0.0}) &&
                   size + 2 < bytes.size());
      std::string damaged = bytes;
      for (const char value : {'\0', '\xFF', '#', '9'}) {
        damaged[size] = value;
        (void)parse_depth_image(damaged, {1000.0, 0.0});
      }
    }
  }
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
