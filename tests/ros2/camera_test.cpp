// Frames out of messages: which counts, at which pose, and what is said when none comes.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "canopeer/config/robot_file.h"
#include "canopeer/ros2/camera/camera_feed.h"

namespace canopeer::ros {
namespace {

constexpr Stamp kMs = 1'000'000;
constexpr Stamp kStart = 1000 * kNanosecondsPerSecond;

const RobotModel& ur5e() {
  static const RobotModel robot =
      *load_robot(std::string(CANOPEER_SOURCE_DIR) + "/robots/ur5e_trolley/robot.yaml");
  return robot;
}

/// A camera that stands before the feed: messages as a driver would send them.
class CameraFeedTest : public ::testing::Test {
 protected:
  void make(const std::vector<FramePart>& parts = {FramePart::depth, FramePart::color}) {
    CameraFeed::Parts made;
    made.intake.parts = parts;
    made.intake.sync.max_difference = nanoseconds(settings_.max_difference_s);
    made.intake.needs_info = parts.front() == FramePart::depth;
    made.assembly.min_confidence = settings_.min_confidence;
    made.topic = [](FramePart part) { return "/" + std::string(name_of(part)); };
    made.info_topic = "/info";
    made.odd_publishers = [](const std::string&) { return std::string(); };
    made.mission_time_s = [](Stamp stamp) { return seconds(stamp - kStart); };
    feed_ = std::make_unique<CameraFeed>(settings_, made, joints_,
                                         poses_of_joints(ur5e(), joints_, [](Stamp) {
                                           return TrolleyState{1.0, 0.2};
                                         }));
    sensor_msgs::CameraInfo info;
    info.width = 8;
    info.height = 6;
    info.k = {5, 0, 3.5, 0, 5, 2.5, 0, 0, 1};
    feed_->intake().set_info(info);
  }
  static std_msgs::Header header(Stamp ms, const std::string& frame = "optical") {
    std_msgs::Header header;
    header.stamp = ros_time(kStart + ms * kMs);
    header.frame_id = frame;
    return header;
  }
  static sensor_msgs::Image image(Stamp ms, const std::string& encoding, std::uint32_t octets,
                                  std::uint32_t width = 8, std::uint32_t height = 6) {
    sensor_msgs::Image image;
    image.header = header(ms);
    image.encoding = encoding;
    image.width = width;
    image.height = height;
    image.step = octets * width;
    image.data.assign(std::size_t{image.step} * height, 0);
    return image;
  }
  static sensor_msgs::Image depth(Stamp ms, float metres = 1.0F) {
    sensor_msgs::Image depth = image(ms, "32FC1", 4);
    for (std::size_t i = 0; i < depth.data.size(); i += 4) {
      std::memcpy(&depth.data[i], &metres, 4);
    }
    return depth;
  }
  void put(FramePart part, sensor_msgs::Image message) {
    feed_->intake().add(part, std::move(message), kStart);
  }
  void put_frame(Stamp ms) {
    put(FramePart::color, image(ms, "rgb8", 3));
    put(FramePart::depth, depth(ms));
  }
  void put_joints(Stamp ms, const Configuration& q) {
    for (int j = 0; j < ur5e().dof(); ++j) joints_.add(j, {kStart + ms * kMs, q[j]});
  }
  [[nodiscard]] std::string error_of_capture() {
    const auto frame = feed_->capture();
    return frame ? "no error" : frame.error().message;
  }

  Ros2CameraSettings settings_ = [] {
    Ros2CameraSettings settings;
    settings.timeout_s = 0.1;
    return settings;
  }();
  const Configuration home_ = ur5e().home("side_1");
  JointHistory joints_{ur5e().setup().arm_joints};
  std::unique_ptr<CameraFeed> feed_;
};

TEST_F(CameraFeedTest, TheNewestFrameAfterTheArmStoodStillCounts) {
  make();
  Configuration q = home_;
  for (Stamp t = 0; t <= 500; t += 10) {  // moves up to 300 ms
    if (t <= 300) q[0] += 0.01;
    put_joints(t, q);
  }
  for (Stamp t = 5; t < 400; t += 33) put_frame(t);
  EXPECT_NE(error_of_capture().find("before the arm had stood still"), std::string::npos)
      << error_of_capture();
  put_frame(401);
  put_frame(434);
  const auto frame = feed_->capture();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->stamp, kStart + 434 * kMs);
  EXPECT_NEAR(frame->frame.time_s, 0.434, 1e-9);
  EXPECT_TRUE(frame->frame.T_world_camera.isApprox(
      ur5e().T_world_base({1.0, 0.2}) * ur5e().T_base_camera(q), 1e-9));
  EXPECT_FLOAT_EQ(frame->frame.depth.at(3, 3), 1.0F);
  EXPECT_DOUBLE_EQ(frame->frame.intrinsics.cx, 4.0);
}

TEST_F(CameraFeedTest, AFrameIsWaitedForAndSoAreItsJointStates) {
  settings_.timeout_s = 20.0;
  make();
  for (Stamp t = 0; t <= 500; t += 10) put_joints(t, home_);
  put_frame(-100);
  std::thread driver([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    put_frame(520);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    put_joints(530, home_);
  });
  const auto frame = feed_->capture();
  driver.join();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp, kStart + 520 * kMs);
}

TEST_F(CameraFeedTest, FramesFromBeforeSomethingStoppedDoNotCount) {
  make();
  for (Stamp t = 0; t <= 1000; t += 10) put_joints(t, home_);
  put_frame(700);
  ASSERT_TRUE(feed_->capture());
  feed_->not_before(kStart + 650 * kMs);  // and settle_s is 100 ms
  EXPECT_FALSE(feed_->capture());
  put_frame(760);
  EXPECT_TRUE(feed_->capture());
}

TEST_F(CameraFeedTest, NoFrameIsGivenTwiceUnlessTheClockWasSetBack) {
  make();
  for (Stamp t = 0; t <= 1000; t += 10) put_joints(t, home_);
  put_frame(700);
  ASSERT_TRUE(feed_->capture());
  EXPECT_NE(error_of_capture().find("nothing came on /depth since the last frame"),
            std::string::npos)
      << error_of_capture();
  put_frame(733);
  const auto next = feed_->capture();
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_EQ(next->stamp, kStart + 733 * kMs);
  for (Stamp t = -60000; t <= -59000; t += 10) put_joints(t, home_);
  put_frame(-59300);
  EXPECT_TRUE(feed_->capture());
}

/// A wall seen by a pinhole of 12 x 10 pixels with focal length 50.
sensor_msgs::PointCloud2 wall(const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.width = 12;
  cloud.height = 10;
  const auto real = sensor_msgs::PointField::FLOAT32;
  cloud.fields = {{"x", 0, real, 1}, {"y", 4, real, 1}, {"z", 8, real, 1}, {"rgb", 12, real, 1}};
  cloud.point_step = 16;
  cloud.row_step = 16 * cloud.width;
  for (int v = 0; v < 10; ++v) {
    for (int u = 0; u < 12; ++u) {
      const float z = 1.0F + 0.01F * static_cast<float>(u);
      const float point[4] = {(static_cast<float>(u) - 5.5F) / 50.0F * z,
                              (static_cast<float>(v) - 4.5F) / 50.0F * z, z, 0.0F};
      std::uint8_t octets[sizeof point];
      std::memcpy(octets, point, sizeof point);
      cloud.data.insert(cloud.data.end(), octets, octets + sizeof point);
    }
  }
  return cloud;
}

TEST_F(CameraFeedTest, ACloudIsNotMeasuredByTheInfoOfAnotherCamera) {
  make({FramePart::points});
  for (Stamp t = 0; t <= 1000; t += 10) put_joints(t, home_);
  feed_->intake().add(FramePart::points, wall(header(700)), kStart);
  const auto frame = feed_->capture();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_NEAR(frame->frame.intrinsics.fx, 50.0, 1e-2);
}

TEST(FrameMessages, TextsAndFieldsTakeMemoryToo) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = std::string(1000, 'x');
  cloud.fields.resize(100);
  EXPECT_GE(octets_of(PartMessage(cloud)), 1000 + 100 * sizeof(sensor_msgs::PointField));
  sensor_msgs::Image image;
  image.encoding = std::string(1000, 'x');
  image.data.resize(10);
  EXPECT_EQ(octets_of(PartMessage(image)), 1010u);
}

TEST_F(CameraFeedTest, FramesFromWhileItMovesAreAtThePosesInBetween) {
  settings_.time_offset_s = -0.05;  // the camera's clock is ahead
  make();
  Configuration q = home_;
  for (Stamp t = 0; t <= 300; t += 20) {
    q[0] = home_[0] + 1e-3 * static_cast<double>(t);
    q[3] = home_[3] - 2e-3 * static_cast<double>(t);
    put_joints(t, q);
  }
  for (Stamp t = 60; t < 400; t += 33) put_frame(t);
  const auto frames = feed_->frames_since(kStart);
  ASSERT_EQ(frames.size(), 9u);  // up to 324 ms, 274 ms of the arm; 307 ms is not known yet
  for (const TimedFrame& timed : frames) {
    const double t = static_cast<double>(timed.stamp - kStart) / kMs;
    q = home_;
    q[0] += 1e-3 * t;
    q[3] -= 2e-3 * t;
    EXPECT_TRUE(timed.frame.T_world_camera.isApprox(
        ur5e().T_world_base({1.0, 0.2}) * ur5e().T_base_camera(q), 1e-9));
  }
  EXPECT_EQ(feed_->frames_since(frames[5].stamp).size(), 3u);
}

TEST_F(CameraFeedTest, SaysWhichTopicIsSilent) {
  make();
  EXPECT_NE(error_of_capture().find("joint states"), std::string::npos);
  for (Stamp t = 0; t <= 500; t += 10) put_joints(t, home_);
  EXPECT_NE(error_of_capture().find("nothing came on /depth, nor on /color"), std::string::npos);
  put(FramePart::depth, depth(400));
  EXPECT_NE(error_of_capture().find("nothing came on /color"), std::string::npos);
}

TEST_F(CameraFeedTest, SaysThatStampsDoNotMeet) {
  make();
  for (Stamp t = 0; t <= 500; t += 10) put_joints(t, home_);
  for (Stamp t = 200; t < 500; t += 100) {
    put(FramePart::depth, depth(t));
    put(FramePart::color, image(t + 50, "rgb8", 3));
  }
  EXPECT_NE(error_of_capture().find("no depth and colour within 0.02 s"), std::string::npos);
}

TEST_F(CameraFeedTest, SaysThatClocksDiffer) {
  make();
  for (Stamp t = 0; t <= 500; t += 10) put_joints(t, home_);
  put_frame(2500);
  EXPECT_NE(error_of_capture().find("joint states end 2.000 s before"), std::string::npos)
      << error_of_capture();
}

TEST_F(CameraFeedTest, MalformedImagesAreCountedAndPassedOver) {
  make();
  for (Stamp t = 0; t <= 900; t += 10) put_joints(t, home_);
  put(FramePart::color, image(500, "rgb8", 3));
  auto cut = depth(500);
  cut.data.resize(17);
  put(FramePart::depth, cut);
  EXPECT_NE(error_of_capture().find("damaged"), std::string::npos);
  EXPECT_EQ(feed_->malformed(), 1);
  put_frame(533);
  EXPECT_TRUE(feed_->capture());
  sensor_msgs::Image unstamped = depth(600);
  unstamped.header.stamp = {};
  put(FramePart::depth, unstamped);
  EXPECT_EQ(feed_->intake().heard(FramePart::depth).without_stamp, 1);
}

TEST_F(CameraFeedTest, DepthFromAnotherPlaceIsRefusedWithWhatToEnable) {
  make();
  for (Stamp t = 0; t <= 900; t += 10) put_joints(t, home_);
  auto from_aside = depth(500);
  from_aside.header.frame_id = "camera_depth_optical_frame";
  put(FramePart::color, image(500, "rgb8", 3));
  put(FramePart::depth, from_aside);
  EXPECT_NE(error_of_capture().find("align_depth"), std::string::npos);
}

TEST_F(CameraFeedTest, RegisteredImagesOfAnotherSizeAreScaled) {
  make();
  for (Stamp t = 0; t <= 900; t += 10) put_joints(t, home_);
  sensor_msgs::Image color = image(500, "mono8", 1, 16, 12);
  for (std::size_t i = 0; i < color.data.size(); ++i) {
    color.data[i] = static_cast<std::uint8_t>(i % 16);
  }
  put(FramePart::color, color);
  put(FramePart::depth, depth(500));
  const auto frame = feed_->capture();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->frame.color.width(), 8);
  EXPECT_EQ(frame->frame.color.at(3, 2).r, 7);
  EXPECT_DOUBLE_EQ(frame->frame.intrinsics.cx, 4.0);
}

TEST_F(CameraFeedTest, LabelsBelowTheConfidenceAreBackground) {
  make({FramePart::depth, FramePart::color, FramePart::labels, FramePart::confidences});
  for (Stamp t = 0; t <= 900; t += 10) put_joints(t, home_);
  put_frame(500);
  auto labels = image(500, "mono8", 1);
  labels.data.assign(labels.data.size(), 3);
  auto sure = image(500, "mono8", 1);
  sure.data[5] = 200;
  put(FramePart::labels, labels);
  put(FramePart::confidences, sure);
  const auto frame = feed_->capture();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->frame.labels.at(5, 0), PixelLabel::ripe_fruit);
  EXPECT_EQ(frame->frame.labels.at(4, 0), PixelLabel::background);
}

TEST_F(CameraFeedTest, WhatIsKeptIsBounded) {
  make();
  for (Stamp t = 0; t <= 9900; t += 100) put_joints(t, home_);
  for (Stamp t = 0; t < 9900; t += 33) put_frame(t);
  EXPECT_EQ(feed_->intake().after(0).size(), FrameIntakeOptions().max_kept);
  EXPECT_EQ(feed_->intake().joined(), 300);
}

TEST(FrameAssembly, TopicsNamesSayWhatImagesAre) {
  const auto realsense =
      assembly_options("/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw");
  EXPECT_TRUE(realsense.color_is_raw);
  EXPECT_TRUE(realsense.depth_is_raw);
  EXPECT_TRUE(realsense.depth_is_registered);
  const auto zed = assembly_options("/zed/rgb/image_rect_color", "/zed/depth/depth_registered");
  EXPECT_FALSE(zed.color_is_raw);
  EXPECT_TRUE(zed.depth_is_registered);
}

}  // namespace
}  // namespace canopeer::ros
