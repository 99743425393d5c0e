// The camera over DDS: a driver in another node, as a mission hears it.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "canopeer/config/robot_file.h"
#include "canopeer/ros2/camera/ros2_camera.h"
#include "dds/ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using testing_support::eventually;
using testing_support::make_node;

const RobotModel& trolley_robot() {
  static const RobotModel robot =
      *load_robot(std::string(CANOPEER_SOURCE_DIR) + "/robots/ur5e_trolley/robot.yaml");
  return robot;
}

Stamp system_now() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

class Ros2CameraTest : public ::testing::Test {
 protected:
  void make() {
    camera_ = must(Ros2Camera::make(*ours_, settings_,
                                    {trolley_robot(), joints_, [](Stamp) { return TrolleyState(); },
                                     system_now, [](Stamp stamp) { return seconds(stamp); }}));
  }
  static sensor_msgs::Image image(Stamp stamp, const std::string& encoding, std::uint32_t octets) {
    sensor_msgs::Image image;
    image.header.stamp = ros_time(stamp);
    image.header.frame_id = "optical";
    image.encoding = encoding;
    image.width = 64;
    image.height = 48;
    image.step = octets * image.width;
    image.data.assign(std::size_t{image.step} * image.height, 7);
    return image;
  }
  static sensor_msgs::CameraInfo info() {
    sensor_msgs::CameraInfo info;
    info.width = 64;
    info.height = 48;
    info.k = {60, 0, 31.5, 0, 60, 23.5, 0, 0, 1};
    return info;
  }
  void joints_now() {
    const Configuration q = trolley_robot().home("side_1");
    const Stamp now = system_now();
    for (int j = 0; j < trolley_robot().dof(); ++j) joints_.add(j, {now, q[j]});
  }
  /// The driver's loop, until a frame came.
  template <class Step>
  Expected<RgbdFrame> capture_while(const Step& step) {
    std::atomic<bool> done = false;
    std::thread driver([&] {
      while (!done) {
        const Stamp stamp = system_now();
        joints_now();
        step(stamp);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        joints_now();
      }
    });
    auto frame = camera_->capture();
    done = true;
    driver.join();
    return frame;
  }

  Ros2CameraSettings settings_ = [] {
    Ros2CameraSettings settings;
    settings.color = "/cam/color";
    settings.depth = "/cam/depth";
    settings.info = "/cam/info";
    settings.timeout_s = 30.0;
    return settings;
  }();
  JointHistory joints_{trolley_robot().setup().arm_joints};
  std::unique_ptr<Node> driver_ = make_node("driver");
  std::unique_ptr<Node> ours_ = make_node("ours");
  std::unique_ptr<Ros2Camera> camera_;
};

TEST_F(Ros2CameraTest, TakesFramesFromThreeTopics) {
  make();
  const auto color = must(driver_->advertise<sensor_msgs::Image>("/cam/color"));
  const auto depth = must(driver_->advertise<sensor_msgs::Image>("/cam/depth"));
  const auto infos = must(driver_->advertise<sensor_msgs::CameraInfo>("/cam/info"));
  const auto frame = capture_while([&](Stamp stamp) {
    color.publish(image(stamp, "bgr8", 3));
    depth.publish(image(stamp, "16UC1", 2));
    infos.publish(info());
  });
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->color.width(), 64);
  EXPECT_NEAR(frame->depth.at(1, 1), 0x0707 * 1e-3, 1e-6);
  EXPECT_TRUE(frame->T_world_camera.isApprox(
      trolley_robot().T_world_base({}) *
      trolley_robot().T_base_camera(trolley_robot().home("side_1"))));
  EXPECT_EQ(camera_->latencies().waited_s.size(), 1u);
}

TEST_F(Ros2CameraTest, TakesPosesFromTf) {
  settings_.pose = "tf";
  settings_.world_frame = "arm_base";
  make();
  const auto color = must(driver_->advertise<sensor_msgs::Image>("/cam/color"));
  const auto depth = must(driver_->advertise<sensor_msgs::Image>("/cam/depth"));
  const auto infos = must(driver_->advertise<sensor_msgs::CameraInfo>("/cam/info"));
  const auto tf = must(driver_->advertise<tf2_msgs::TFMessage>("/tf", kTfQos));
  const auto fixed = must(driver_->advertise<tf2_msgs::TFMessage>("/tf_static", kLatchedQos));
  const auto step = [](const std::string& parent, const std::string& child, Stamp stamp, double x) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.header.stamp = ros_time(stamp);
    transform.child_frame_id = child;
    transform.transform.translation.x = x;
    return tf2_msgs::TFMessage{{transform}};
  };
  fixed.publish(step("tool", "optical", 0, 0.5));
  const auto frame = capture_while([&](Stamp stamp) {
    color.publish(image(stamp, "rgb8", 3));
    depth.publish(image(stamp, "16UC1", 2));
    infos.publish(info());
    tf.publish(step("arm_base", "tool", system_now(), 0.25));
  });
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_TRUE(frame->T_world_camera.translation().isApprox(trolley_robot().T_world_base({}) *
                                                           Vec3(0.75, 0.0, 0.0)));
}

TEST_F(Ros2CameraTest, SaysWhatIsWrongWithPublishers) {
  settings_.timeout_s = 0.3;
  settings_.reliable = true;
  settings_.labels = "/labels";
  make();
  joints_now();
  const auto color = must(driver_->advertise<sensor_msgs::Image>("/cam/color", kSensorQos));
  const auto depth = must(driver_->advertise<sensor_msgs::CompressedImage>("/cam/depth"));
  ASSERT_TRUE(eventually([&] {
    return ours_->publishers_of("/cam/color").size() == 1 &&
           ours_->publishers_of("/cam/depth").size() == 1;
  }));
  const auto frame = camera_->capture();
  ASSERT_FALSE(frame);
  const std::string& said = frame.error().message;
  EXPECT_NE(said.find("/cam/depth (its type is sensor_msgs/msg/CompressedImage, expected "
                      "sensor_msgs/msg/Image)"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("/cam/color (it is published best effort"), std::string::npos) << said;
  EXPECT_NE(said.find("/labels (nobody publishes it)"), std::string::npos) << said;
}

TEST_F(Ros2CameraTest, WithACloudNobodyAsksForTheInfoOfTheColourCamera) {
  settings_.points = "/cam/points";
  make();
  ASSERT_TRUE(eventually([&] { return driver_->subscribers_of("/cam/points").size() == 1; }));
  EXPECT_TRUE(driver_->subscribers_of("/cam/info").empty());
}

}  // namespace
}  // namespace canopeer::ros
