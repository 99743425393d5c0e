// Messages of cameras as pixels: encodings, compression, clouds, lenses; and what is damaged.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rng.h"
#include "canopeer/ros2/camera/camera_model.h"
#include "canopeer/ros2/camera/compressed_image.h"
#include "canopeer/ros2/camera/organised_cloud.h"
#include "canopeer/ros2/camera/raw_image.h"
#include "canopeer/sensing/jpeg.h"
#include "canopeer/sensing/lens_distortion.h"
#include "canopeer/sensing/png.h"

namespace canopeer::ros {
namespace {

/// Rows of `octets` in each pixel, padded.
sensor_msgs::Image image_of(const std::string& encoding, std::uint32_t width, std::uint32_t height,
                            std::vector<std::uint8_t> pixels, std::uint32_t padding = 0) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  const std::size_t row = pixels.size() / height;
  image.step = static_cast<std::uint32_t>(row) + padding;
  for (std::size_t v = 0; v < height; ++v) {
    image.data.insert(image.data.end(), pixels.begin() + static_cast<std::ptrdiff_t>(v * row),
                      pixels.begin() + static_cast<std::ptrdiff_t>((v + 1) * row));
    image.data.insert(image.data.end(), padding, 0xEE);
  }
  return image;
}

template <class T>
std::vector<std::uint8_t> octets(const std::vector<T>& values, bool big_endian = false) {
  std::vector<std::uint8_t> bytes;
  for (const T value : values) {
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    bytes.insert(bytes.end(), raw, raw + sizeof(T));
  }
  return bytes;
}

std::vector<std::uint8_t> jpeg_of(const ColorImage& image) {
  const std::string bytes = encode_jpeg(image, 95);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::uint8_t> png_of(const DepthImage& depth, double units_per_m) {
  const auto path =
      std::filesystem::temp_directory_path() / ("images_test_" + std::to_string(getpid()) + ".png");
  EXPECT_TRUE(write_depth_png(path, depth, units_per_m));
  const std::string bytes = *read_file(path);
  std::filesystem::remove(path);
  return {bytes.begin(), bytes.end()};
}

TEST(RosImages, ColoursAreReadInEveryOrderOfChannels) {
  const std::vector<std::uint8_t> rgb = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<std::uint8_t> bgra = {3, 2, 1, 0, 6, 5, 4, 0, 9, 8, 7, 0, 12, 11, 10, 0};
  const auto a = color_of(image_of("rgb8", 2, 2, rgb, 5));
  const auto b = color_of(image_of("bgra8", 2, 2, bgra, 3));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->at(1, 1), (Rgb{10, 11, 12}));
  EXPECT_EQ(a->pixels(), b->pixels());
  EXPECT_EQ(color_of(image_of("bgr8", 2, 2, rgb))->at(0, 1), (Rgb{9, 8, 7}));
  EXPECT_EQ(color_of(image_of("rgba8", 2, 2, bgra))->at(0, 0), (Rgb{3, 2, 1}));
  EXPECT_EQ(color_of(image_of("mono8", 4, 3, rgb))->at(3, 2), (Rgb{12, 12, 12}));
}

TEST(RosImages, OtherEncodingsAreRefusedWithAnAdvice) {
  const auto color = color_of(image_of("bayer_rggb8", 2, 2, {1, 2, 3, 4}));
  ASSERT_FALSE(color);
  EXPECT_NE(color.error().message.find("'bayer_rggb8'; set the camera driver to rgb8"),
            std::string::npos);
  EXPECT_FALSE(depth_of(image_of("rgb8", 1, 1, {1, 2, 3})));
  EXPECT_FALSE(labels_of(image_of("rgb8", 1, 1, {1, 2, 3})));
}

TEST(RosImages, DepthIsReadInMillimetresAndMetresInBothByteOrders) {
  for (const bool big : {false, true}) {
    auto mm = image_of("16UC1", 2, 2, octets<std::uint16_t>({0, 65535, 1234, 400}, big), 6);
    mm.is_bigendian = big;
    const auto a = depth_of(mm);
    ASSERT_TRUE(a);
    EXPECT_EQ(a->pixels(), (std::vector<float>{0.0F, 0.0F, 1.234F, 0.4F}));
    auto m = image_of("32FC1", 3, 2,
                      octets<float>({NAN, INFINITY, -1.0F, 0.0F, 1.5F, -INFINITY}, big), 4);
    m.is_bigendian = big;
    const auto b = depth_of(m);
    ASSERT_TRUE(b);
    EXPECT_EQ(b->pixels(), (std::vector<float>{0, 0, 0, 0, 1.5F, 0}));
  }
}

TEST(RosImages, SizesThatDoNotFitTheOctetsAreDamage) {
  auto image = image_of("rgb8", 2, 2, std::vector<std::uint8_t>(12));
  auto cut = image;
  cut.data.pop_back();
  EXPECT_FALSE(color_of(cut));
  auto narrow = image;
  narrow.step = 5;
  EXPECT_FALSE(color_of(narrow));
  auto huge = image;
  huge.width = 0xFFFFFFFF;
  huge.height = 0xFFFFFFFF;
  huge.step = 0xFFFFFFFF;
  EXPECT_FALSE(color_of(huge));
  auto none = image;
  none.height = 0;
  EXPECT_FALSE(color_of(none));
}

TEST(RosImages, LabelsAreValuesOfPixelLabel) {
  const auto labels = labels_of(image_of("8UC1", 2, 2, {0, 1, 2, 3}));
  ASSERT_TRUE(labels);
  EXPECT_EQ(labels->at(1, 1), PixelLabel::ripe_fruit);
  EXPECT_FALSE(labels_of(image_of("mono8", 2, 2, {0, 1, 2, 4})));
  EXPECT_FLOAT_EQ(confidences_of(image_of("mono8", 2, 1, {0, 255}))->at(1, 0), 1.0F);
  const auto sure = confidences_of(image_of("32FC1", 3, 1, octets<float>({NAN, 0.25F, 7.0F})));
  EXPECT_EQ(sure->pixels(), (std::vector<float>{0.0F, 0.25F, 1.0F}));
}

TEST(RosImages, JpegAndWhatIsLeftOfOne) {
  ColorImage image(64, 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) image.at(u, v) = {static_cast<std::uint8_t>(4 * u), 128, 60};
  }
  sensor_msgs::CompressedImage message;
  message.format = "rgb8; jpeg compressed bgr8";
  message.data = jpeg_of(image);
  const auto read = color_of(message);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->width(), 64);
  EXPECT_NEAR(read->at(40, 20).r, 160, 6);
  EXPECT_NEAR(read->at(40, 20).b, 60, 6);
  const auto whole = message.data;
  for (std::size_t size = 0; size + 2 < whole.size(); size += 7) {
    message.data.assign(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(color_of(message)) << size;
  }
  Rng rng(1, 1);
  for (int round = 0; round < 300; ++round) {  // anything but a crash
    message.data = whole;
    for (int i = 0; i < 5; ++i) {
      const double place = rng.uniform(0.0, static_cast<double>(message.data.size()));
      message.data[static_cast<std::size_t>(place)] =
          static_cast<std::uint8_t>(rng.uniform(0.0, 256.0));
    }
    static_cast<void>(color_of(message));
  }
}

TEST(RosImages, CompressedDepthInMillimetres) {
  DepthImage depth(4, 3, 1.25F);
  depth.at(0, 0) = 0.0F;
  sensor_msgs::CompressedImage message;
  message.format = "16UC1; compressedDepth png";
  message.data = std::vector<std::uint8_t>(12, 0);
  const auto png = png_of(depth, 1000.0);
  message.data.insert(message.data.end(), png.begin(), png.end());
  const auto read = depth_of(message);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->pixels(), depth.pixels());
  message.format = "16UC1; compressedDepth";  // of older drivers
  EXPECT_TRUE(depth_of(message));
  message.format = "16UC1; compressedDepth rvl";
  EXPECT_NE(depth_of(message).error().message.find("set the driver's parameter"),
            std::string::npos);
  message.format = "16UC1; png compressed ";
  message.data = png;
  EXPECT_EQ(depth_of(message)->pixels(), depth.pixels());
}

TEST(RosImages, CompressedDepthInInverseDepths) {
  // As the plugin packs them with depth_quantization 100 and depth_max 10 m.
  const float a = 100.0F * 101.0F, b = 1.0F - a / 10.0F;
  const std::vector<float> metres = {0.5F, 1.0F, 2.0F, 9.0F};
  DepthImage samples(4, 1);
  for (int u = 0; u < 4; ++u) {
    samples.at(u, 0) = std::floor(a / metres[static_cast<std::size_t>(u)] + b);
  }
  sensor_msgs::CompressedImage message;
  message.format = "32FC1; compressedDepth png";
  message.data = octets<std::uint32_t>({0});
  const auto head = octets<float>({a, b});
  message.data.insert(message.data.end(), head.begin(), head.end());
  const auto png = png_of(samples, 1.0);
  message.data.insert(message.data.end(), png.begin(), png.end());
  const auto read = depth_of(message);
  ASSERT_TRUE(read) << read.error().message;
  for (int u = 0; u < 4; ++u) {
    const float z = metres[static_cast<std::size_t>(u)];
    EXPECT_NEAR(read->at(u, 0), z, z * z / a * 1.01F);  // one step of the quantisation
  }
  message.data[7] = 0xFF;  // a: not a number that makes sense
  message.data[6] = 0xFF;
  EXPECT_FALSE(depth_of(message));
  message.data.resize(12);
  EXPECT_FALSE(depth_of(message));
}

TEST(RosImages, APngThatClaimsToBeHugeIsRefusedBeforeItsMemoryIsTaken) {
  auto png = png_of(DepthImage(2, 2, 1.0F), 1000.0);
  png[16] = png[20] = 0x40;  // width and height beyond 10⁹
  sensor_msgs::CompressedImage message;
  message.data = png;
  EXPECT_FALSE(color_of(message));
  EXPECT_FALSE(depth_of(message));
}

/// A cloud of a wall 1 m away that leans, seen by a pinhole.
sensor_msgs::PointCloud2 cloud_of(const CameraIntrinsics& k, bool doubles, bool big) {
  sensor_msgs::PointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(k.width);
  cloud.height = static_cast<std::uint32_t>(k.height);
  cloud.is_bigendian = big;
  const std::uint32_t real = doubles ? 8 : 4;
  const std::uint8_t type =
      doubles ? sensor_msgs::PointField::FLOAT64 : sensor_msgs::PointField::FLOAT32;
  // Colour first, then y, z, x, and a field that nobody knows.
  cloud.fields = {{"rgb", 0, sensor_msgs::PointField::FLOAT32, 1},
                  {"y", 4, type, 1},
                  {"z", 4 + real, type, 1},
                  {"x", 4 + 2 * real, type, 1},
                  {"intensity", 4 + 3 * real, sensor_msgs::PointField::UINT8, 1}};
  cloud.point_step = 4 + 3 * real + 1;
  cloud.row_step = cloud.point_step * cloud.width + 3;
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      double z = 1.0 + 0.3 * k.ray(u, v).x();
      if (u == 0) z = NAN;
      const Vec3 p = z * k.ray(u, v);
      const auto put = [&](const auto& bytes) {
        cloud.data.insert(cloud.data.end(), bytes.begin(), bytes.end());
      };
      put(octets<std::uint32_t>({0x00112233u}, big));
      for (const double value : {p.y(), p.z(), p.x()}) {
        if (doubles) put(octets<double>({value}, big));
        if (!doubles) put(octets<float>({static_cast<float>(value)}, big));
      }
      cloud.data.push_back(7);
    }
    cloud.data.insert(cloud.data.end(), 3, 0);
  }
  return cloud;
}

TEST(RosImages, AnOrganisedCloudSaysItsCameraByItself) {
  CameraIntrinsics k = CameraIntrinsics::from_fov(40, 30, 1.2);
  k.cx += 1.5;
  k.fy *= 1.1;
  for (const bool doubles : {false, true}) {
    const auto images = images_of(cloud_of(k, doubles, doubles));
    ASSERT_TRUE(images) << images.error().message;
    EXPECT_EQ(images->color.at(3, 4), (Rgb{0x11, 0x22, 0x33}));
    EXPECT_EQ(images->depth.at(0, 7), 0.0F);
    EXPECT_NEAR(images->depth.at(39, 7), 1.0 + 0.3 * k.ray(39, 7).x(), 1e-6);
    ASSERT_TRUE(images->intrinsics);
    EXPECT_NEAR(images->intrinsics->fx, k.fx, 1e-3);
    EXPECT_NEAR(images->intrinsics->fy, k.fy, 1e-3);
    EXPECT_NEAR(images->intrinsics->cx, k.cx, 1e-3);
    EXPECT_NEAR(images->intrinsics->cy, k.cy, 1e-3);
  }
}

TEST(RosImages, PointsFarBeyondAnyCamerasReachAreNone) {
  const CameraIntrinsics k = CameraIntrinsics::from_fov(40, 30, 1.2);
  auto cloud = cloud_of(k, true, false);
  const double far = 1e300;
  std::memcpy(&cloud.data[5 * cloud.row_step + 6 * cloud.point_step + cloud.fields[2].offset], &far,
              sizeof far);
  const auto images = images_of(cloud);
  ASSERT_TRUE(images) << images.error().message;
  EXPECT_EQ(images->depth.at(6, 5), 0.0F);
}

TEST(RosImages, CloudsThatAreNoImagesAreRefused) {
  const CameraIntrinsics k = CameraIntrinsics::from_fov(40, 30, 1.2);
  auto flat = cloud_of(k, false, false);
  flat.width *= flat.height;
  flat.height = 1;
  EXPECT_NE(images_of(flat).error().message.find("not organised"), std::string::npos);
  auto cut = cloud_of(k, false, false);
  cut.data.resize(cut.data.size() - 4);
  EXPECT_FALSE(images_of(cut));
  auto outside = cloud_of(k, false, false);
  outside.fields[3].offset = outside.point_step - 2;
  EXPECT_FALSE(images_of(outside));
  auto moved = cloud_of(k, false, false);  // x forward, as in a robot's base
  std::swap(moved.fields[2].name, moved.fields[3].name);
  EXPECT_NE(images_of(moved).error().message.find("optical frame"), std::string::npos);
}

sensor_msgs::CameraInfo info_of(std::uint32_t width, std::uint32_t height) {
  sensor_msgs::CameraInfo info;
  info.width = width;
  info.height = height;
  info.distortion_model = "plumb_bob";
  info.k = {600, 0, 319.5, 0, 610, 239.5, 0, 0, 1};
  info.p = {590, 0, 320.5, 0, 0, 605, 238.5, 0, 0, 0, 1, 0};
  return info;
}

TEST(CameraInfo, CentreOfPixelsRegionAndBinning) {
  auto info = info_of(640, 480);
  const auto plain = camera_model(info, 640, 480, true);
  ASSERT_TRUE(plain);
  EXPECT_DOUBLE_EQ(plain->intrinsics.cx, 320.0);
  EXPECT_EQ(plain->without_lens, nullptr);
  EXPECT_DOUBLE_EQ(camera_model(info, 640, 480, false)->intrinsics.fx, 590.0);
  EXPECT_DOUBLE_EQ(camera_model(info, 320, 240, true)->intrinsics.cx, 160.0);
  info.roi.x_offset = 40;
  info.roi.y_offset = 20;
  info.roi.width = 400;
  info.roi.height = 300;
  info.binning_x = info.binning_y = 2;
  const auto part = camera_model(info, 200, 150, true);
  ASSERT_TRUE(part) << part.error().message;
  EXPECT_DOUBLE_EQ(part->intrinsics.fx, 300.0);
  EXPECT_DOUBLE_EQ(part->intrinsics.cx, 140.0);
  EXPECT_DOUBLE_EQ(part->intrinsics.cy, 110.0);
}

TEST(CameraInfo, WhatCannotBeUsedIsSaid) {
  auto info = info_of(640, 480);
  EXPECT_NE(camera_model(info, 640, 400, true).error().message.find("another camera"),
            std::string::npos);
  info.d = {0.1, 0.1, 0, 0, 0};
  info.distortion_model = "thin_prism";
  EXPECT_FALSE(camera_model(info, 640, 480, true));
  EXPECT_TRUE(camera_model(info, 640, 480, false));
  info = info_of(640, 480);
  info.k = {};
  EXPECT_NE(camera_model(info, 640, 480, true).error().message.find("calibrat"), std::string::npos);
  info.k[0] = NAN;
  EXPECT_FALSE(camera_model(info, 640, 480, true));
}

TEST(CameraInfo, SizesThatNoImageHasAreSaid) {
  auto info = info_of(0xFFFFFFFF, 0xFFFFFFFF);
  EXPECT_NE(camera_model(info, 640, 480, true).error().message.find("the camera info: an image of"),
            std::string::npos);
  info = info_of(640, 480);
  info.roi.width = info.roi.height = 0xFFFFFFFF;
  EXPECT_FALSE(camera_model(info, 640, 480, true));
  info = info_of(640, 480);
  info.binning_x = info.binning_y = 1000;
  EXPECT_FALSE(camera_model(info, 640, 480, true));
}

TEST(CameraInfo, LensesAreTakenOut) {
  auto info = info_of(64, 48);
  info.k = {60, 0, 31.5, 0, 60, 23.5, 0, 0, 1};
  info.d = {-0.2, 0.05, 0.001, -0.002, 0.0};
  const LensDistortion lens{-0.2, 0.05, 0.001, -0.002, 0.0};
  // Each pixel of the raw image says its column.
  Image<float> raw(64, 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) raw.at(u, v) = static_cast<float>(u);
  }
  const auto model = camera_model(info, 64, 48, true);
  ASSERT_TRUE(model && model->without_lens);
  const Image<float> flat = model->without_lens->apply(raw, -1.0F);
  const CameraIntrinsics& k = model->intrinsics;
  for (const auto& [u, v] : {std::pair(10, 8), std::pair(32, 24), std::pair(55, 40)}) {
    const Eigen::Vector2d seen = lens.distort(k.ray(u, v).head<2>());
    EXPECT_NEAR(flat.at(u, v) + 0.5, seen.x() * k.fx + k.cx, 0.51);
  }
  // The same polynomial with six more numbers that are 0.
  info.distortion_model = "rational_polynomial";
  info.d = {-0.2, 0.05, 0.001, -0.002, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(camera_model(info, 64, 48, true)->without_lens->apply(raw, -1.0F).pixels(),
            flat.pixels());
  info.distortion_model = "equidistant";
  info.d = {0.1, 0.0, 0.0, 0.0};
  const auto fisheye = camera_model(info, 64, 48, true)->without_lens->apply(raw, -1.0F);
  const Vec3 ray = k.ray(50, 24);
  const double angle = std::atan(ray.head<2>().norm());
  const double seen = angle * (1 + 0.1 * angle * angle) / ray.head<2>().norm() * ray.x();
  EXPECT_NEAR(fisheye.at(50, 24) + 0.5, seen * k.fx + k.cx, 0.51);
}

}  // namespace
}  // namespace canopeer::ros
