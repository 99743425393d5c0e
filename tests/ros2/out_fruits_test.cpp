#include <gtest/gtest.h>

#include "canopeer/ros2/out/detection_picture.h"
#include "canopeer/ros2/out/fruit_detections.h"
#include "canopeer/ros2/out/fruit_markers.h"
#include "canopeer/ros2/out/label_colors.h"
#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {
namespace {

using visualization_msgs::Marker;

const std_msgs::Header kInMap = header_of("map", 7);

FruitEstimate a_fruit() {
  FruitEstimate fruit;
  fruit.id = 12;
  fruit.centre = {1.0, 2.0, 3.0};
  fruit.semi_axes_m = {0.03, 0.04, 0.05};
  fruit.e1 = 0.8;
  fruit.e2 = 1.2;
  fruit.roll_pitch_yaw_rad = {0.3, -0.2, 1.0};
  fruit.volume_cm3 = 251.4;
  fruit.volume_sd_cm3 = 12.0;
  fruit.confidence = 0.934;
  fruit.centre_sd_m = {0.001, 0.002, 0.003};
  fruit.ripeness = PixelLabel::ripe_fruit;
  return fruit;
}

Pose pose_from(const geometry_msgs::Pose& pose) {
  Pose T = Pose::Identity();
  T.translation() = Vec3(pose.position.x, pose.position.y, pose.position.z);
  const auto& q = pose.orientation;
  T.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  return T;
}

TEST(FruitDetections, SayWhereHowBigAndHowSure) {
  const auto message = fruit_detections({a_fruit()}, kInMap);
  EXPECT_EQ(message.header.frame_id, "map");
  ASSERT_EQ(message.detections.size(), 1u);
  const auto& detection = message.detections[0];
  EXPECT_EQ(detection.header.frame_id, "map");
  EXPECT_EQ(detection.id, "12");
  EXPECT_TRUE(pose_from(detection.bbox.center).isApprox(a_fruit().body().T_world_body, 1e-12));
  EXPECT_DOUBLE_EQ(detection.bbox.size.x, 0.06);
  EXPECT_DOUBLE_EQ(detection.bbox.size.z, 0.10);
  ASSERT_EQ(detection.results.size(), 1u);
  const auto& result = detection.results[0];
  EXPECT_EQ(result.hypothesis.class_id, "ripe");
  EXPECT_DOUBLE_EQ(result.hypothesis.score, 0.934);
  EXPECT_DOUBLE_EQ(result.pose.covariance[0], 1e-6);
  EXPECT_DOUBLE_EQ(result.pose.covariance[7], 4e-6);
  EXPECT_DOUBLE_EQ(result.pose.covariance[14], 9e-6);
  EXPECT_DOUBLE_EQ(result.pose.covariance[1], 0.0);
}

TEST(FruitDetections, NobodySaidHowRipe) {
  FruitEstimate fruit = a_fruit();
  fruit.ripeness = PixelLabel::background;
  EXPECT_EQ(fruit_detections({fruit}, kInMap).detections[0].results[0].hypothesis.class_id,
            "fruit");
}

TEST(FruitMarkers, LieOnTheFittedSurface) {
  const FruitEstimate fruit = a_fruit();
  const auto markers = fruit_markers({fruit}, kInMap).markers;
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].action, Marker::DELETEALL);
  const Marker& shape = markers[1];
  EXPECT_EQ(shape.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(shape.id, 12);
  EXPECT_FLOAT_EQ(shape.color.r, 214.0F / 255.0F);
  ASSERT_EQ(shape.points.size() % 3, 0u);
  const Pose T = pose_from(shape.pose);
  for (const auto& point : shape.points) {
    EXPECT_NEAR(fruit.body().gauge(T * Vec3(point.x, point.y, point.z)), 1.0, 1e-9);
  }
  EXPECT_EQ(markers[2].text, "12: 251 ± 12 cm³, 93 %");
  EXPECT_GT(markers[2].pose.position.z, 3.05);
}

TEST(FruitMarkers, AreClosedAndFaceOutwards) {
  // Signed volume of the triangles by the divergence theorem: near the shape's, and positive.
  FruitEstimate fruit = a_fruit();
  fruit.e1 = fruit.e2 = 1.0;
  const Marker shape = fruit_markers({fruit}, kInMap).markers[1];
  double volume = 0.0;
  for (std::size_t i = 0; i < shape.points.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return Vec3(shape.points[i + k].x, shape.points[i + k].y, shape.points[i + k].z);
    };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
  }
  EXPECT_NEAR(volume / fruit.body().volume_m3(), 0.88, 0.05);  // a polyhedron within
}

TEST(FruitMarkers, OfNoFruitsDeleteThoseBefore) {
  const auto markers = fruit_markers({}, kInMap).markers;
  ASSERT_EQ(markers.size(), 1u);
  EXPECT_EQ(markers[0].action, Marker::DELETEALL);
}

TEST(DetectionPicture, TintsFruitsAndDrawsTheirOutline) {
  RgbdFrame frame;
  frame.color = ColorImage(5, 5, Rgb{100, 100, 100});
  frame.depth = DepthImage(5, 5, 1.0F);
  Detection detection;
  detection.fruit = Mask(5, 5);
  for (int v = 1; v < 4; ++v) {
    for (int u = 1; u < 4; ++u) {
      detection.fruit.at(u, v) = static_cast<std::uint8_t>(PixelLabel::ripe_fruit);
    }
  }
  const auto image = detection_picture(frame, detection, kInMap);
  EXPECT_EQ(image.encoding, "rgb8");
  EXPECT_EQ(image.step, 15u);
  const auto pixel = [&](std::size_t u, std::size_t v) {
    return Rgb{image.data[v * 15 + 3 * u], image.data[v * 15 + 3 * u + 1],
               image.data[v * 15 + 3 * u + 2]};
  };
  EXPECT_EQ(pixel(0, 0), (Rgb{100, 100, 100}));
  EXPECT_EQ(pixel(1, 1), label_color(PixelLabel::ripe_fruit));
  EXPECT_EQ(pixel(2, 2), (Rgb{157, 77, 69}));
}

TEST(DetectionPicture, WithoutColourIsGreyByDepth) {
  RgbdFrame frame;
  frame.intrinsics.max_range_m = 2.0;
  frame.depth = DepthImage(2, 1, 1.0F);
  frame.depth.at(1, 0) = 0.0F;
  const auto image = detection_picture(frame, Detection(), kInMap);
  ASSERT_EQ(image.data.size(), 6u);
  EXPECT_EQ(image.data[0], 157);
  EXPECT_EQ(image.data[3], 0);
}

}  // namespace
}  // namespace canopeer::ros
