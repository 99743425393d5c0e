#include "recording.h"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "canopeer/config/camera_file.h"
#include "canopeer/detect/color_detector.h"
#include "canopeer/map/cloud_fusion.h"
#include "canopeer/sensing/depth_file.h"
#include "canopeer/sensing/png.h"
#include "canopeer/sensing/pose_check.h"
#include "canopeer/sensing/tum_sequence.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

class TumRecording final : public Recording {
 public:
  TumRecording(TumSequence sequence, CameraFile camera, bool by_color)
      : sequence_(std::move(sequence)), camera_(std::move(camera)), by_color_(by_color) {}

  [[nodiscard]] std::size_t size() const override { return sequence_.frames.size(); }
  [[nodiscard]] std::string name(std::size_t i) const override {
    return sequence_.frames[i].depth.string();
  }
  [[nodiscard]] std::optional<Pose> pose(std::size_t i) const override {
    return sequence_.frames[i].T_world_camera;
  }
  [[nodiscard]] const PoseSource& poses() const override { return sequence_.poses; }
  [[nodiscard]] PoseGaps gaps() const override { return sequence_.gaps; }

  [[nodiscard]] Expected<Observation> load(std::size_t i) const override {
    const TumFrame& files = sequence_.frames[i];
    auto depth = read_depth_image(files.depth, camera_.depth);
    if (!depth) return tl::unexpected(depth.error());
    SegmentedFrame segmented;
    RgbdFrame& frame = segmented.frame;
    frame.time_s = files.time_s;
    frame.T_world_camera = files.T_world_camera;
    frame.depth = *std::move(depth);
    frame.intrinsics = camera_.intrinsics;
    frame.intrinsics.width = frame.depth.width();
    frame.intrinsics.height = frame.depth.height();
    if (auto fits = check_size(frame, files.depth); !fits) return tl::unexpected(fits.error());
    if (by_color_ && !files.color.empty()) {
      if (auto done = segment(segmented, files.color); !done) return tl::unexpected(done.error());
    }
    return segmented;
  }

 private:
  [[nodiscard]] Expected<void> check_size(const RgbdFrame& frame, const fs::path& file) const {
    const CameraIntrinsics& k = camera_.intrinsics;
    const auto differs = [](int stated, int real) { return stated != 0 && stated != real; };
    if (!differs(k.width, frame.depth.width()) && !differs(k.height, frame.depth.height())) {
      return {};
    }
    return fail(file.string() + ": the image has " + std::to_string(frame.depth.width()) + " x " +
                std::to_string(frame.depth.height()) + " pixels, the camera file says " +
                std::to_string(k.width) + " x " + std::to_string(k.height));
  }

  [[nodiscard]] static Expected<void> segment(SegmentedFrame& segmented, const fs::path& file) {
    auto color = read_png(file);
    if (!color) return tl::unexpected(color.error());
    const RgbdFrame& frame = segmented.frame;
    if (color->width() != frame.depth.width() || color->height() != frame.depth.height()) {
      return fail(file.string() + ": the colour image is not as large as its depth image");
    }
    segmented.frame.color = *std::move(color);
    segmented.roi = ColorDetector().detect(segmented.frame)->fruit;
    return {};
  }

  TumSequence sequence_;
  CameraFile camera_;
  bool by_color_;
};

class CloudRecording final : public Recording {
 public:
  explicit CloudRecording(CloudFolder folder) : folder_(std::move(folder)) {}
  [[nodiscard]] std::size_t size() const override { return folder_.frames.size(); }
  [[nodiscard]] std::string name(std::size_t i) const override {
    return folder_.frames[i].file.string();
  }
  [[nodiscard]] std::optional<Pose> pose(std::size_t i) const override {
    return folder_.frames[i].T_world_points;
  }
  [[nodiscard]] const PoseSource& poses() const override { return folder_.poses; }
  [[nodiscard]] PoseGaps gaps() const override { return folder_.gaps; }
  [[nodiscard]] Expected<Observation> load(std::size_t i) const override {
    auto cloud = load_cloud(folder_, i);
    if (!cloud) return tl::unexpected(cloud.error());
    return *std::move(cloud);
  }

 private:
  CloudFolder folder_;
};

Expected<CameraFile> camera_of(const MapFuseArguments& arguments) {
  CameraFile camera;
  const fs::path own = fs::path(arguments.dataset) / "camera.yaml";
  std::error_code code;
  if (!arguments.intrinsics.empty()) {
    const std::vector<double>& k = arguments.intrinsics;
    if (!(k[0] > 0.0 && k[1] != 0.0)) return fail("--intrinsics: FX must be positive, FY not 0");
    camera.intrinsics = intrinsics_of(k[0], std::abs(k[1]), k[2], k[3]);
    camera.y_up = k[1] < 0.0;
  } else if (!arguments.camera.empty() || fs::exists(own, code)) {
    auto file = load_camera(arguments.camera.empty() ? own : fs::path(arguments.camera));
    if (!file) return file;
    camera = *std::move(file);
  } else {
    return fail(
        arguments.dataset +
        ": the camera's intrinsics are not known; pass --intrinsics FX,FY,CX,CY or --camera "
        "FILE, or put a camera.yaml there");
  }
  if (arguments.depth_units_per_m) camera.depth.per_m = *arguments.depth_units_per_m;
  return camera;
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_recording(const MapFuseArguments& arguments) {
  const fs::path directory = arguments.dataset;
  std::error_code code;
  if (!fs::is_directory(directory, code)) {
    return fail(
        arguments.dataset +
        ": is no folder; expected a TUM RGB-D sequence (depth.txt, groundtruth.txt, …) or a "
        "folder of .ply or .pcd clouds");
  }
  if (!is_tum_sequence(directory)) {
    if (arguments.roi == "color") {
      return fail(arguments.dataset +
                  ": --roi color needs the colour images of an RGB-D sequence; clouds say what is "
                  "fruit by a property `roi`");
    }
    auto folder =
        open_cloud_folder(directory, {arguments.max_pose_gap_s, fs::path(arguments.trajectory)});
    if (!folder) {
      return fail(folder.error().message +
                  " (nor was depth.txt, associations.txt or a folder depth there)");
    }
    return std::make_unique<CloudRecording>(*std::move(folder));
  }
  auto camera = camera_of(arguments);
  if (!camera) return tl::unexpected(camera.error());
  auto sequence = open_tum_sequence(
      directory, {arguments.max_difference_s, arguments.max_pose_gap_s, arguments.trajectory});
  if (!sequence) return tl::unexpected(sequence.error());
  if (camera->y_up) {
    for (TumFrame& frame : sequence->frames) frame.T_world_camera = mirrored(frame.T_world_camera);
    sequence->poses.notices.push_back(
        "fy is negative: the camera's y axis points up and its poses are left-handed; camera and "
        "world are mirrored (y changes its sign)");
  }
  const bool by_color = arguments.roi == "color";
  if (by_color && static_cast<std::size_t>(sequence->without_color) == sequence->frames.size()) {
    return fail(arguments.dataset +
                ": --roi color needs colour images, but none is near a depth image in time; see "
                "rgb.txt and --max-difference");
  }
  return std::make_unique<TumRecording>(*std::move(sequence), *std::move(camera), by_color);
}

Expected<std::int64_t> fuse_observation(VoxelMap& map, const Observation& observation,
                                        const FusionOptions& fusion) {
  CloudFusionOptions options;
  options.max_range_m = fusion.max_range_m;
  CloudScan scan;
  if (const auto* cloud = std::get_if<PosedCloud>(&observation)) {
    scan.points = cloud->file.cloud.points;
    scan.roi_confidence = cloud->file.roi_confidence;
    scan.T_world_points = cloud->T_world_points;
    if (auto fits = check_placement(map, scan, options); !fits) return tl::unexpected(fits.error());
    return fuse_cloud(map, scan, options).fused_points;
  }
  const auto& [frame, roi] = std::get<SegmentedFrame>(observation);
  scan.T_world_points = frame.T_world_camera;
  if (auto fits = check_placement(map, scan, options); !fits) return tl::unexpected(fits.error());
  return fuse(map, frame, roi, fusion).fused_points;
}

}  // namespace canopeer::app
