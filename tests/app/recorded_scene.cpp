#include "recorded_scene.h"

#include <array>
#include <charconv>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"
#include "canopeer/sensing/png.h"
#include "canopeer/sensing/point_cloud.h"

namespace canopeer::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string pose_line(double time_s, const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  std::string line = text_of(time_s);
  for (const double v : {pose.translation().x(), pose.translation().y(), pose.translation().z(),
                         q.x(), q.y(), q.z(), q.w()}) {
    line += " " + text_of(v);
  }
  return line + "\n";
}

void write(const fs::path& path, const std::string& content) {
  CANOPEER_CHECK(write_file(path, content).has_value(), "a test's own file");
}

PointCloud cloud_of(const RgbdFrame& frame) {
  PointCloud cloud;
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      const double depth = static_cast<double>(frame.depth.at(u, v));
      cloud.points.emplace_back((depth * frame.intrinsics.ray(u, v)).cast<float>());
    }
  }
  return cloud;
}

}  // namespace

RecordedScene RecordedScene::make(std::uint64_t seed, int count) {
  const BallScene scene = BallScene::random(seed, 60);
  Rng rng(seed, "recording");
  RecordedScene recorded;
  for (int i = 0; i < count; ++i) {
    auto view =
        scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(160, 120, 1.396));
    view.frame.color = ColorImage(160, 120, Rgb{60, 130, 50});
    for (std::size_t p = 0; p < view.roi.pixels().size(); ++p) {
      if (view.roi.pixels()[p] != 0) view.frame.color.pixels()[p] = Rgb{220, 30, 20};
    }
    recorded.views.push_back(std::move(view));
  }
  return recorded;
}

void RecordedScene::write_tum(const fs::path& directory) const {
  fs::create_directories(directory / "depth");
  fs::create_directories(directory / "rgb");
  std::string depth = "# depth images\n", color = "# colour images\n";
  std::string poses = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < views.size(); ++i) {
    const RgbdFrame& frame = views[i].frame;
    const std::string file = std::to_string(i) + ".png";
    CANOPEER_CHECK(
        write_depth_png(directory / "depth" / file, frame.depth, kDepthUnits).has_value() &&
            write_png(directory / "rgb" / file, frame.color).has_value(),
        "a test's own file");
    const double time_s = static_cast<double>(i);
    depth += text_of(time_s) + " depth/" + file + "\n";
    color += text_of(time_s + 0.01) + " rgb/" + file + "\n";
    poses += pose_line(time_s - 0.125, frame.T_world_camera);
    poses += pose_line(time_s + 0.125, frame.T_world_camera);
  }
  write(directory / "depth.txt", depth);
  write(directory / "rgb.txt", color);
  write(directory / "groundtruth.txt", poses);
  const CameraIntrinsics& k = views.front().frame.intrinsics;
  write(directory / "camera.yaml",
        "fx_px: " + text_of(k.fx) + "\nfy_px: " + text_of(k.fy) +
            "\ncx_px: " + text_of(k.cx - 0.5) + "\ncy_px: " + text_of(k.cy - 0.5) +
            "\nwidth_px: 160\nheight_px: 120\ndepth_units_per_m: " + text_of(kDepthUnits) + "\n");
}

void RecordedScene::write_ply_folder(const fs::path& directory) const {
  fs::create_directories(directory);
  std::string poses;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string name = "cloud_" + std::to_string(i) + ".ply";
    CANOPEER_CHECK(write_ply(directory / name, cloud_of(views[i].frame)).has_value(),
                   "a test's own file");
    poses += pose_line(static_cast<double>(i), views[i].frame.T_world_camera);
  }
  write(directory / "poses.txt", poses);
}

void RecordedScene::write_pcd_folder(const fs::path& directory) const {
  fs::create_directories(directory);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Pose& pose = views[i].frame.T_world_camera;
    const Eigen::Quaterniond q(pose.linear());
    const PointCloud cloud = cloud_of(views[i].frame);
    std::string bytes =
        "VERSION 0.7\nFIELDS x y z roi\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n";
    bytes += "WIDTH 160\nHEIGHT 120\nVIEWPOINT";
    for (const double v : {pose.translation().x(), pose.translation().y(), pose.translation().z(),
                           q.w(), q.x(), q.y(), q.z()}) {
      bytes += " " + text_of(v);
    }
    bytes += "\nPOINTS " + std::to_string(cloud.points.size()) + "\nDATA binary\n";
    for (std::size_t p = 0; p < cloud.points.size(); ++p) {
      for (int axis = 0; axis < 3; ++axis) append_number(bytes, cloud.points[p][axis]);
      append_number(bytes, views[i].roi.pixels()[p] != 0 ? 1.0F : 0.0F);
    }
    write(directory / ("cloud_" + std::to_string(i) + ".pcd"), bytes);
  }
}

}  // namespace canopeer::test
