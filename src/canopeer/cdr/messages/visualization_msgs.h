#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/builtin_interfaces.h"
#include "canopeer/cdr/messages/geometry_msgs.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::visualization_msgs {

struct UVCoordinate {
  static constexpr std::string_view kType = "visualization_msgs/msg/UVCoordinate";
  float u{}, v{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(u, v);
  }
};

struct MeshFile {
  static constexpr std::string_view kType = "visualization_msgs/msg/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;
  template <class Archive>
  void visit(Archive& archive) {
    archive(filename, data);
  }
};

struct Marker {
  static constexpr std::string_view kType = "visualization_msgs/msg/Marker";
  static constexpr std::int32_t ARROW = 0;
  static constexpr std::int32_t CUBE = 1;
  static constexpr std::int32_t SPHERE = 2;
  static constexpr std::int32_t CYLINDER = 3;
  static constexpr std::int32_t LINE_STRIP = 4;
  static constexpr std::int32_t LINE_LIST = 5;
  static constexpr std::int32_t CUBE_LIST = 6;
  static constexpr std::int32_t SPHERE_LIST = 7;
  static constexpr std::int32_t POINTS = 8;
  static constexpr std::int32_t TEXT_VIEW_FACING = 9;
  static constexpr std::int32_t MESH_RESOURCE = 10;
  static constexpr std::int32_t TRIANGLE_LIST = 11;
  static constexpr std::int32_t ADD = 0;
  static constexpr std::int32_t DELETE = 2;
  static constexpr std::int32_t DELETEALL = 3;
  std_msgs::Header header;
  std::string ns;
  std::int32_t id{};
  std::int32_t type{};
  std::int32_t action{};
  geometry_msgs::Pose pose;
  geometry_msgs::Vector3 scale;
  std_msgs::ColorRGBA color;
  builtin_interfaces::Duration lifetime;
  bool frame_locked{};
  std::vector<geometry_msgs::Point> points;
  std::vector<std_msgs::ColorRGBA> colors;
  std::string texture_resource;
  sensor_msgs::CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, ns, id, type, action, pose, scale, color, lifetime, frame_locked, points,
            colors, texture_resource, texture, uv_coordinates, text, mesh_resource, mesh_file,
            mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  static constexpr std::string_view kType = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;
  template <class Archive>
  void visit(Archive& archive) {
    archive(markers);
  }
};

}  // namespace canopeer::ros::visualization_msgs
