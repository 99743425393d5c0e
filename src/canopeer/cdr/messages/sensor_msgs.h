#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::sensor_msgs {

/// `encoding`: "rgb8", "16UC1" …; `step`: octets of a row.
struct Image {
  static constexpr std::string_view kType = "sensor_msgs/msg/Image";
  std_msgs::Header header;
  std::uint32_t height{};
  std::uint32_t width{};
  std::string encoding;
  std::uint8_t is_bigendian{};
  std::uint32_t step{};
  std::vector<std::uint8_t> data;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, height, width, encoding, is_bigendian, step, data);
  }
};

struct CompressedImage {
  static constexpr std::string_view kType = "sensor_msgs/msg/CompressedImage";
  std_msgs::Header header;
  std::string format;
  std::vector<std::uint8_t> data;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, format, data);
  }
};

struct RegionOfInterest {
  static constexpr std::string_view kType = "sensor_msgs/msg/RegionOfInterest";
  std::uint32_t x_offset{};
  std::uint32_t y_offset{};
  std::uint32_t height{};
  std::uint32_t width{};
  bool do_rectify{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(x_offset, y_offset, height, width, do_rectify);
  }
};

/// Matrices row by row.
struct CameraInfo {
  static constexpr std::string_view kType = "sensor_msgs/msg/CameraInfo";
  static constexpr std::size_t kMostOctets = 1u << 20;
  std_msgs::Header header;
  std::uint32_t height{};
  std::uint32_t width{};
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{};
  std::array<double, 9> r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x{};
  std::uint32_t binning_y{};
  RegionOfInterest roi;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, height, width, distortion_model, d, k, r, p, binning_x, binning_y, roi);
  }
};

/// Each of the last three is as long as `name` or empty.
struct JointState {
  static constexpr std::string_view kType = "sensor_msgs/msg/JointState";
  static constexpr std::size_t kMostOctets = 1u << 20;
  std_msgs::Header header;
  std::vector<std::string> name;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> effort;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, name, position, velocity, effort);
  }
};

struct PointField {
  static constexpr std::string_view kType = "sensor_msgs/msg/PointField";
  static constexpr std::uint8_t INT8 = 1;
  static constexpr std::uint8_t UINT8 = 2;
  static constexpr std::uint8_t INT16 = 3;
  static constexpr std::uint8_t UINT16 = 4;
  static constexpr std::uint8_t INT32 = 5;
  static constexpr std::uint8_t UINT32 = 6;
  static constexpr std::uint8_t FLOAT32 = 7;
  static constexpr std::uint8_t FLOAT64 = 8;
  std::string name;
  std::uint32_t offset{};
  std::uint8_t datatype{};
  std::uint32_t count{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(name, offset, datatype, count);
  }
};

struct PointCloud2 {
  static constexpr std::string_view kType = "sensor_msgs/msg/PointCloud2";
  std_msgs::Header header;
  std::uint32_t height{};
  std::uint32_t width{};
  std::vector<PointField> fields;
  bool is_bigendian{};
  std::uint32_t point_step{};
  std::uint32_t row_step{};
  std::vector<std::uint8_t> data;
  bool is_dense{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, height, width, fields, is_bigendian, point_step, row_step, data, is_dense);
  }
};

}  // namespace canopeer::ros::sensor_msgs
