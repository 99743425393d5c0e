#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/builtin_interfaces.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::std_msgs {

struct Header {
  static constexpr std::string_view kType = "std_msgs/msg/Header";
  builtin_interfaces::Time stamp;
  std::string frame_id;
  template <class Archive>
  void visit(Archive& archive) {
    archive(stamp, frame_id);
  }
};

struct String {
  static constexpr std::string_view kType = "std_msgs/msg/String";
  std::string data;
  template <class Archive>
  void visit(Archive& archive) {
    archive(data);
  }
};

struct Bool {
  static constexpr std::string_view kType = "std_msgs/msg/Bool";
  bool data{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(data);
  }
};

struct Float64 {
  static constexpr std::string_view kType = "std_msgs/msg/Float64";
  double data{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(data);
  }
};

/// 0 … 1.
struct ColorRGBA {
  static constexpr std::string_view kType = "std_msgs/msg/ColorRGBA";
  float r{}, g{}, b{}, a{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(r, g, b, a);
  }
};

struct MultiArrayDimension {
  static constexpr std::string_view kType = "std_msgs/msg/MultiArrayDimension";
  std::string label;
  std::uint32_t size{};
  std::uint32_t stride{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(label, size, stride);
  }
};

struct MultiArrayLayout {
  static constexpr std::string_view kType = "std_msgs/msg/MultiArrayLayout";
  std::vector<MultiArrayDimension> dim;
  std::uint32_t data_offset{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(dim, data_offset);
  }
};

struct Float64MultiArray {
  static constexpr std::string_view kType = "std_msgs/msg/Float64MultiArray";
  MultiArrayLayout layout;
  std::vector<double> data;
  template <class Archive>
  void visit(Archive& archive) {
    archive(layout, data);
  }
};

}  // namespace canopeer::ros::std_msgs
